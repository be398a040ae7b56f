// SPDX-License-Identifier: MIT
// An image as plain data: named channels of floats or unsigned integers, and attributes that describe it.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace izb {

/// One plane of an image: width times height values, rows from top to bottom.
struct Channel {
  std::string name;
  std::variant<std::vector<float>, std::vector<uint32_t>> data;
};

/// What an image may say about itself. The 16 floats are a 4 x 4 matrix for row vectors (p' = p M), stored
/// row after row: the same memory as a column-major matrix for column vectors, so a glm::mat4 is copied as it
/// lies.
using Attribute =
    std::variant<std::string, int, float, double, std::array<float, 2>, std::array<float, 3>, std::array<float, 16>>;

struct Image {
  int width_px = 0, height_px = 0;
  std::vector<Channel> channels;
  std::map<std::string, Attribute> attributes;

  size_t pixel_count() const { return size_t(width_px) * size_t(height_px); }

  /// Appends a channel of zeros and returns its values. The reference holds until the next channel is added.
  std::vector<float>& add_float(std::string name);
  std::vector<uint32_t>& add_uint(std::string name);

  /// Appends a channel of given values. Throws std::logic_error if their number is not pixel_count().
  void add(std::string name, std::vector<float> values);
  void add(std::string name, std::vector<uint32_t> values);

  /// The channel of that name, or nullptr.
  const Channel* find(const std::string& name) const;

  /// The values of the channel of that name. Throws izb::Error if it is missing or of the other type.
  const std::vector<float>& floats(const std::string& name) const;
  const std::vector<uint32_t>& uints(const std::string& name) const;
};

/// A picture of 8 bits a component, rows from top to bottom, pixels in a row without padding.
struct Image8 {
  int width_px = 0, height_px = 0;
  int components = 3;  ///< 3: RGB, 4: RGB and alpha (not premultiplied)
  std::vector<uint8_t> pixels;
};

}  // namespace izb
