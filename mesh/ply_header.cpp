#include "mesh/ply_header.h"

#include <fmt/format.h>

#include <charconv>

#include "case/enum_names.h"
#include "case/input_error.h"
#include "mesh/mesh_words.h"

namespace plumbline {
namespace {

constexpr std::array<std::string_view, 8> sized_type_names = {"int8",  "uint8",  "int16",   "uint16",
                                                              "int32", "uint32", "float32", "float64"};

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  PlyHeader run() {
    next_line();
    if (words_.size() != 1 || words_[0] != "ply") fail("is no PLY: the first line has to be 'ply'");
    next_line();
    read_format();
    while (next_line(), words_ != std::vector<std::string_view>{"end_header"}) {
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") continue;
      if (words_[0] == "element")
        read_element();
      else if (words_[0] == "property")
        read_property();
      else
        fail(fmt::format("{} is no keyword of a PLY header; remove the line, or write 'comment' in front",
                         quoted(words_[0])));
    }
    give_roles();
    header_.size = at_;
    header_.lines = line_;
    return std::move(header_);
  }

 private:
  void next_line() {
    const auto end = bytes_.find('\n', at_);
    if (end == bytes_.npos)
      throw InputError(fmt::format("{}: no 'end_header'; the file is cut off, or no PLY", file_));
    split_words(bytes_.substr(at_, end - at_), words_);
    at_ = end + 1;
    ++line_;
  }

  void read_format() {
    if (words_.size() != 3 || words_[0] != "format") fail("'format ... 1.0' has to follow 'ply'");
    const auto format = from_name<PlyFormat>(ply_format_names, words_[1]);
    if (!format) fail(fmt::format("format {}; there are {}", quoted(words_[1]), fmt::join(ply_format_names, ", ")));
    header_.format = *format;
  }

  void read_element() {
    std::uint64_t items = 0;
    if (words_.size() != 3) fail("write element NAME COUNT");
    const char* const end = words_[2].data() + words_[2].size();
    if (const auto [rest, error] = std::from_chars(words_[2].data(), end, items); error != std::errc{} || rest != end)
      fail(fmt::format("{} is no count", quoted(words_[2])));
    header_.elements.push_back({std::string(words_[1]), items, {}});
  }

  void read_property() {
    if (header_.elements.empty()) fail("a property in front of the first element");
    const bool list = words_.size() > 1 && words_[1] == "list";
    if (words_.size() != (list ? 5u : 3u)) fail("write property TYPE NAME, or property list COUNT_TYPE TYPE NAME");
    PlyProperty property = {std::string(words_.back()), type(words_[words_.size() - 2]), std::nullopt};
    if (list) {
      property.count = type(words_[2]);
      if (!is_integer(*property.count)) fail("the count of a list has to be an integer");
    }
    header_.elements.back().properties.push_back(property);
  }

  PlyType type(std::string_view word) const {
    if (const auto found = from_name<PlyType>(ply_type_names, word)) return *found;
    if (const auto found = from_name<PlyType>(sized_type_names, word)) return *found;
    fail(fmt::format("type {}; there are {}", quoted(word), fmt::join(ply_type_names, ", ")));
  }

  void give_roles() {
    int vertices = 0, faces = 0;
    for (PlyElement& element : header_.elements) {
      if (element.properties.empty()) fail(fmt::format("element {} has no property", quoted(element.name)));
      if (element.name == "vertex" || element.name == "vertices") {
        ++vertices;
        for (const std::string_view axis : {"x", "y", "z"}) give_coordinate(element, axis);
      } else if (element.name == "face" || element.name == "faces") {
        ++faces;
        give_corners(element);
      }
    }
    if (vertices != 1) fail(fmt::format("{} elements 'vertex'; there has to be one", vertices));
    if (faces > 1) fail(fmt::format("{} elements 'face'; there may be one", faces));
  }

  void give_coordinate(PlyElement& element, std::string_view axis) const {
    int found = 0;
    for (PlyProperty& property : element.properties) {
      if (property.name != axis) continue;
      ++found;
      if (property.count || is_integer(property.type))
        fail(fmt::format("property {} of a vertex has to be a float or a double", axis));
      property.role = PlyRole::coordinate;
    }
    if (found != 1) fail(fmt::format("{} properties {} of a vertex; there has to be one", found, axis));
  }

  void give_corners(PlyElement& element) const {
    int found = 0;
    for (PlyProperty& property : element.properties) {
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      ++found;
      if (!property.count || (property.type != PlyType::int32 && property.type != PlyType::uint32))
        fail(fmt::format("property {} of a face has to be a list of int or uint", property.name));
      property.role = PlyRole::corners;
    }
    if (found != 1) fail(fmt::format("{} lists vertex_indices of a face; there has to be one", found));
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line_, what));
  }

  std::string_view bytes_;
  const std::string& file_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0, line_ = 0;
  PlyHeader header_ = {};
};

std::string_view plain_name(const PlyProperty& property) {
  switch (property.role) {
    case PlyRole::coordinate:
      return property.name;
    case PlyRole::corners:
      return "vertex_indices";
    case PlyRole::none:
      break;
  }
  return "_";
}

std::string_view plain_name(const PlyElement& element) {
  for (const PlyProperty& property : element.properties) {
    if (property.role == PlyRole::coordinate) return "vertex";
    if (property.role == PlyRole::corners) return "face";
  }
  return "_";
}

}  // namespace

PlyHeader read_ply_header(std::string_view bytes, const std::string& file) { return HeaderReader(bytes, file).run(); }

std::string plain_header(const PlyHeader& header) {
  std::string text = fmt::format("ply\nformat {} 1.0\n", name(header.format));
  for (const PlyElement& element : header.elements) {
    text += fmt::format("element {} {}\n", plain_name(element), element.items);
    for (const PlyProperty& property : element.properties) {
      const std::string list = property.count ? fmt::format("list {} ", name(*property.count)) : "";
      text += fmt::format("property {}{} {}\n", list, name(property.type), plain_name(property));
    }
  }
  return text + "end_header\n";
}

}  // namespace plumbline
