// SPDX-License-Identifier: MIT
#include "image/image.h"

#include <algorithm>
#include <stdexcept>

#include "base/error.h"

namespace izb {
namespace {

template <typename T>
std::vector<T>& add_channel(Image& image, std::string name, std::vector<T> values) {
  if (values.size() != image.pixel_count()) throw std::logic_error("channel " + name + " has the wrong size");
  image.channels.push_back({std::move(name), std::move(values)});
  return std::get<std::vector<T>>(image.channels.back().data);
}

template <typename T>
const std::vector<T>& values_of(const Image& image, const std::string& name, const char* type) {
  const Channel* channel = image.find(name);
  if (!channel) fail("the image has no channel '{}'", name);
  const auto* values = std::get_if<std::vector<T>>(&channel->data);
  if (!values) fail("the image's channel '{}' does not hold {} values", name, type);
  return *values;
}

}  // namespace

std::vector<float>& Image::add_float(std::string name) {
  return add_channel(*this, std::move(name), std::vector<float>(pixel_count()));
}

std::vector<uint32_t>& Image::add_uint(std::string name) {
  return add_channel(*this, std::move(name), std::vector<uint32_t>(pixel_count()));
}

void Image::add(std::string name, std::vector<float> values) {
  add_channel(*this, std::move(name), std::move(values));
}

void Image::add(std::string name, std::vector<uint32_t> values) {
  add_channel(*this, std::move(name), std::move(values));
}

const Channel* Image::find(const std::string& name) const {
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

const std::vector<float>& Image::floats(const std::string& name) const {
  return values_of<float>(*this, name, "float");
}

const std::vector<uint32_t>& Image::uints(const std::string& name) const {
  return values_of<uint32_t>(*this, name, "unsigned integer");
}

}  // namespace izb
