// SPDX-License-Identifier: MIT
#include "base/base64.h"

#include <openssl/evp.h>

#include <algorithm>

namespace izb {

std::string base64(std::span<const std::byte> bytes) {
  // EVP_EncodeBlock counts in int and ends what it writes with a zero: parts that are whole groups of three bytes.
  constexpr size_t part_bytes = 3 << 20;
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');
  size_t at = 0;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(part_bytes, bytes.size())))
    at += size_t(EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data() + at),
                                 reinterpret_cast<const unsigned char*>(bytes.data()),
                                 int(std::min(part_bytes, bytes.size()))));
  text.resize(at);
  return text;
}

std::string base64(std::string_view text) {
  return base64(std::as_bytes(std::span(text)));
}

}  // namespace izb
