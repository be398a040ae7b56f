// SPDX-License-Identifier: MIT
#include "image/exr.h"

#include <ImathBox.h>
#include <ImathMatrix.h>
#include <ImathVec.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfVecAttribute.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/error.h"
#include "base/file.h"

namespace izb {
namespace {

constexpr int max_side_px = 1 << 16;

/// OpenEXR encodes into memory, so that only AtomicFile touches the disk.
class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(const std::string& name) : Imf::OStream(name.c_str()) {}
  void write(const char* bytes, int count) override {
    const size_t end = position_ + size_t(count);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + position_, bytes, size_t(count));
    position_ = end;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  size_t position_ = 0;
};

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(const std::string& name, std::span<const std::byte> bytes) : Imf::IStream(name.c_str()), bytes_(bytes) {}
  bool read(char* target, int count) override {
    if (position_ > bytes_.size() || size_t(count) > bytes_.size() - position_) {
      throw std::runtime_error("the file ends too early");
    }
    std::memcpy(target, bytes_.data() + position_, size_t(count));
    position_ += size_t(count);
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  std::span<const std::byte> bytes_;
  size_t position_ = 0;
};

void use_all_cores() {
  static const bool once = [] {
    Imf::setGlobalThreadCount(int(std::max(1u, std::thread::hardware_concurrency())));
    return true;
  }();
  (void)once;
}

/// A slice over rows of `stride` bytes a pixel. OpenEXR addresses pixels by the coordinates of the data
/// window, so the base is moved back by its origin.
Imf::Slice slice(Imf::PixelType type, const void* values, size_t stride, size_t width, Imath::V2i origin) {
  const auto back = ptrdiff_t(stride) * (ptrdiff_t(origin.y) * ptrdiff_t(width) + origin.x);
  char* base = static_cast<char*>(const_cast<void*>(values)) - back;
  return {type, base, stride, stride * width};
}

void set_attribute(Imf::Header& header, const std::string& name, const Attribute& value) {
  struct Insert {
    Imf::Header& header;
    const char* name;
    void operator()(const std::string& v) const { header.insert(name, Imf::StringAttribute(v)); }
    void operator()(int v) const { header.insert(name, Imf::IntAttribute(v)); }
    void operator()(float v) const { header.insert(name, Imf::FloatAttribute(v)); }
    void operator()(double v) const { header.insert(name, Imf::DoubleAttribute(v)); }
    void operator()(const std::array<float, 2>& v) const {
      header.insert(name, Imf::V2fAttribute(Imath::V2f(v[0], v[1])));
    }
    void operator()(const std::array<float, 3>& v) const {
      header.insert(name, Imf::V3fAttribute(Imath::V3f(v[0], v[1], v[2])));
    }
    void operator()(const std::array<float, 16>& v) const {
      Imath::M44f m;
      std::copy(v.begin(), v.end(), &m[0][0]);
      header.insert(name, Imf::M44fAttribute(m));
    }
  };
  std::visit(Insert{header, name.c_str()}, value);
}

template <typename OfType>
const OfType* as(const Imf::Attribute& attribute) {
  return dynamic_cast<const OfType*>(&attribute);
}

void get_attribute(const std::string& name, const Imf::Attribute& attribute, Image& image) {
  static const std::set<std::string> required = {"pixelAspectRatio", "screenWindowCenter", "screenWindowWidth"};
  if (required.contains(name)) return;
  std::map<std::string, Attribute>& to = image.attributes;
  if (const auto* s = as<Imf::StringAttribute>(attribute)) to[name] = s->value();
  if (const auto* i = as<Imf::IntAttribute>(attribute)) to[name] = i->value();
  if (const auto* f = as<Imf::FloatAttribute>(attribute)) to[name] = f->value();
  if (const auto* d = as<Imf::DoubleAttribute>(attribute)) to[name] = d->value();
  if (const auto* v2 = as<Imf::V2fAttribute>(attribute)) {
    to[name] = std::array<float, 2>{v2->value().x, v2->value().y};
  }
  if (const auto* v3 = as<Imf::V3fAttribute>(attribute)) {
    to[name] = std::array<float, 3>{v3->value().x, v3->value().y, v3->value().z};
  }
  if (const auto* m = as<Imf::M44fAttribute>(attribute)) {
    std::array<float, 16> values;
    std::copy_n(&m->value()[0][0], 16, values.begin());
    to[name] = values;
  }
}

bool is_color(const std::string& name) {
  return name == "R" || name == "G" || name == "B" || name == "A";
}

std::vector<half> to_half(const std::vector<float>& values) {
  std::vector<half> halves(values.size());
  std::transform(values.begin(), values.end(), halves.begin(),
                 [](float v) { return half(std::isfinite(v) ? std::clamp(v, -float(HALF_MAX), float(HALF_MAX)) : v); });
  return halves;
}

void encode(Imf::OStream& stream, const Image& image, const ExrOptions& options) {
  Imf::Header header(image.width_px, image.height_px);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = 2;
  for (const auto& [name, value] : image.attributes) set_attribute(header, name, value);

  Imf::FrameBuffer frame;
  std::vector<std::vector<half>> halves;
  for (const Channel& channel : image.channels) {
    const auto insert = [&](Imf::PixelType type, const void* values, size_t stride) {
      header.channels().insert(channel.name, Imf::Channel(type));
      frame.insert(channel.name, slice(type, values, stride, size_t(image.width_px), {0, 0}));
    };
    if (const auto* uints = std::get_if<std::vector<uint32_t>>(&channel.data)) {
      insert(Imf::UINT, uints->data(), 4);
    } else if (const auto& floats = std::get<std::vector<float>>(channel.data);
               options.half_color && is_color(channel.name)) {
      halves.push_back(to_half(floats));
      insert(Imf::HALF, halves.back().data(), 2);
    } else {
      insert(Imf::FLOAT, floats.data(), 4);
    }
  }

  Imf::OutputFile file(stream, header);
  file.setFrameBuffer(frame);
  file.writePixels(image.height_px);
}

Image decode(Imf::IStream& stream) {
  Imf::InputFile file(stream);
  const Imath::Box2i window = file.header().dataWindow();
  const int64_t width = int64_t(window.max.x) - window.min.x + 1, height = int64_t(window.max.y) - window.min.y + 1;
  if (width > max_side_px || height > max_side_px) {
    throw std::runtime_error(fmt::format("its size, {} x {} pixels, is too large", width, height));
  }

  Image image;
  image.width_px = int(width), image.height_px = int(height);
  for (auto a = file.header().begin(); a != file.header().end(); ++a) get_attribute(a.name(), a.attribute(), image);

  Imf::FrameBuffer frame;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1) {
      throw std::runtime_error(fmt::format("its channel '{}' is subsampled", c.name()));
    }
    const bool uints = c.channel().type == Imf::UINT;
    const void* values = uints ? static_cast<void*>(image.add_uint(c.name()).data()) : image.add_float(c.name()).data();
    frame.insert(c.name(), slice(uints ? Imf::UINT : Imf::FLOAT, values, 4, size_t(width), window.min));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

/// OpenEXR's message on one line and without "Cannot read image file "NAME"." before the cause.
std::string cause_of(const std::exception& error, const std::string& name) {
  std::string text = error.what();
  const std::string quoted = "\"" + name + "\". ";
  if (const size_t at = text.find(quoted); at != std::string::npos) text.erase(0, at + quoted.size());
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, text.find_last_not_of(" .") + 1);
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Image& image, const ExrOptions& options) {
  AtomicFile file(path);
  write_exr(file, image, options);
  file.commit();
}

void write_exr(AtomicFile& file, const Image& image, const ExrOptions& options) {
  const std::string name = file.target().string();
  use_all_cores();
  MemoryOutput stream(name);
  try {
    encode(stream, image, options);
  } catch (const std::exception& error) {
    fail("cannot write '{}': {}", name, cause_of(error, name));
  }
  file.write(stream.bytes());
}

Image read_exr(const std::filesystem::path& path) {
  return read_exr(read_binary_file(path), path.string());
}

Image read_exr(std::span<const std::byte> bytes, const std::string& name) {
  use_all_cores();
  MemoryInput stream(name, bytes);
  try {
    return decode(stream);
  } catch (const std::exception& error) {
    fail("cannot read '{}' as OpenEXR: {}", name, cause_of(error, name));
  }
}

std::map<std::string, Attribute> read_exr_attributes(const std::filesystem::path& path) {
  try {
    const Imf::InputFile file(path.c_str());
    Image image;
    for (auto a = file.header().begin(); a != file.header().end(); ++a) get_attribute(a.name(), a.attribute(), image);
    return image.attributes;
  } catch (const std::exception& error) {
    fail("cannot read '{}' as OpenEXR: {}", path.string(), cause_of(error, path.string()));
  }
}

}  // namespace izb
