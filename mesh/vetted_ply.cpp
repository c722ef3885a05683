#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>

#include "case/input_error.h"
#include "case/precision.h"
#include "mesh/mesh_words.h"
#include "mesh/ply_header.h"
#include "mesh/vetted.h"

namespace plumbline {
namespace {

[[noreturn]] void fail_short(const std::string& file, const PlyElement& element, std::uint64_t there) {
  throw InputError(
      fmt::format("{}: the header promises {} items of {}, and the file ends in item {}; it is cut off, or the "
                  "header is wrong",
                  file, element.items, quoted(element.name), there));
}

// CGAL makes room for as many values as the count of a list says before it reads the first.
class BinaryBody {
 public:
  BinaryBody(std::string_view body, const PlyHeader& header, const std::string& file)
      : body_(body), header_(header), file_(file) {}

  void vet() {
    for (const PlyElement& element : header_.elements) {
      const bool lists =
          std::ranges::any_of(element.properties, [](const PlyProperty& p) { return p.count.has_value(); });
      if (lists)
        skip_items(element);
      else
        skip_plain_items(element);
    }
    if (body_.find_first_not_of(" \t\r\n", at_) != body_.npos)
      throw InputError(fmt::format("{}: {} bytes are left behind what the header promises; is a count too small?",
                                   file_, body_.size() - at_));
  }

 private:
  void skip_plain_items(const PlyElement& element) {
    std::size_t size = 0;
    for (const PlyProperty& property : element.properties) size += size_of(property.type);
    const std::uint64_t there = (body_.size() - at_) / size;
    if (there < element.items) fail_short(file_, element, there);
    at_ += element.items * size;
  }

  void skip_items(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.items; ++i)
      for (const PlyProperty& property : element.properties) {
        std::uint64_t values = 1;
        if (property.count) {
          const std::size_t size = size_of(*property.count);
          if (body_.size() - at_ < size) fail_short(file_, element, i);
          values = count(*property.count, element, i);
          at_ += size;
        }
        if ((body_.size() - at_) / size_of(property.type) < values) fail_short(file_, element, i);
        at_ += values * size_of(property.type);
      }
  }

  std::uint64_t count(PlyType type, const PlyElement& element, std::uint64_t item) const {
    std::uint64_t bits = 0;
    const std::size_t size = size_of(type);
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t place = header_.format == PlyFormat::binary_big_endian ? size - 1 - k : k;
      bits |= std::uint64_t{static_cast<unsigned char>(body_[at_ + k])} << (8 * place);
    }
    const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
    if (is_signed && bits >> (8 * size - 1) != 0)
      throw InputError(
          fmt::format("{}: a list of item {} of {} has a negative count", file_, item, quoted(element.name)));
    return bits;
  }

  std::string_view body_;
  const PlyHeader& header_;
  const std::string& file_;
  std::size_t at_ = 0;
};

class AsciiBody {
 public:
  AsciiBody(std::string& bytes, std::size_t begin, const PlyHeader& header, const std::string& file)
      : bytes_(bytes), header_(header), file_(file), at_(begin), line_(header.lines + 1) {}

  void vet() {
    for (const PlyElement& element : header_.elements)
      for (std::uint64_t i = 0; i < element.items; ++i)
        for (const PlyProperty& property : element.properties) {
          const std::uint64_t values = property.count ? count(*property.count, element, i) : 1;
          for (std::uint64_t k = 0; k < values; ++k) vet_value(property, word(element, i));
        }
    if (!next_word().empty()) fail("more numbers than the header promises; is a count too small?");
  }

 private:
  void vet_value(const PlyProperty& property, std::string_view word) {
    switch (property.role) {
      case PlyRole::coordinate: {
        if (const std::string trouble = coordinate_trouble(word); !trouble.empty()) fail(trouble);
        const Precision precision = property.type == PlyType::float32 ? Precision::binary32 : Precision::binary64;
        if (!is_finite(at_precision(*parse_decimal(word), precision)))
          fail(fmt::format("the coordinate {} is beyond a float; let the header say double", quoted(word)));
        return;
      }
      case PlyRole::corners: {
        const std::int64_t limit = property.type == PlyType::int32 ? std::numeric_limits<std::int32_t>::max()
                                                                   : std::numeric_limits<std::uint32_t>::max();
        if (const auto index = integer(word); !index || *index < 0 || *index > limit)
          fail(fmt::format("{} is no index of a vertex", quoted(word)));
        return;
      }
      case PlyRole::none: {  // such as the normal nan nan nan, at which CGAL would stop
        const auto begin = bytes_.begin() + (word.data() - bytes_.data());
        std::fill(begin, begin + static_cast<std::ptrdiff_t>(word.size()), ' ');
        *begin = '0';
        return;
      }
    }
  }

  std::uint64_t count(PlyType type, const PlyElement& element, std::uint64_t item) {
    const std::string_view text = word(element, item);
    const auto value = integer(text);
    const int bits = static_cast<int>(8 * size_of(type)) -
                     (type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32);
    if (!value || *value < 0 || *value >> bits != 0) fail(fmt::format("{} is no count of a list", quoted(text)));
    if (static_cast<std::uint64_t>(*value) > bytes_.size() - at_) fail_short(file_, element, item);
    return static_cast<std::uint64_t>(*value);
  }

  static std::optional<std::int64_t> integer(std::string_view text) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
  }

  std::string_view word(const PlyElement& element, std::uint64_t item) {
    const std::string_view found = next_word();
    if (found.empty()) fail_short(file_, element, item);
    return found;
  }

  std::string_view next_word() {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    while (at_ < bytes_.size() && blanks.find(bytes_[at_]) != blanks.npos) line_ += bytes_[at_++] == '\n';
    const std::size_t begin = at_;
    at_ = std::min(bytes_.find_first_of(blanks, at_), bytes_.size());
    return std::string_view(bytes_).substr(begin, at_ - begin);
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line_, what));
  }

  std::string& bytes_;
  const PlyHeader& header_;
  const std::string& file_;
  std::size_t at_, line_;
};

}  // namespace

std::string vetted_ply(std::string bytes, const std::string& file) {
  const PlyHeader header = read_ply_header(bytes, file);
  if (header.format == PlyFormat::ascii)
    AsciiBody(bytes, header.size, header, file).vet();
  else
    BinaryBody(std::string_view(bytes).substr(header.size), header, file).vet();
  bytes.replace(0, header.size, plain_header(header));
  return bytes;
}

}  // namespace plumbline
