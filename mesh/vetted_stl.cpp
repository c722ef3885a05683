#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "case/float_bits.h"
#include "case/input_error.h"
#include "mesh/mesh_words.h"
#include "mesh/vetted.h"

namespace plumbline {
namespace {

constexpr std::size_t header_size = 80, facets_at = header_size + 4, facet_size = 50;
static_assert(std::endian::native == std::endian::little, "CGAL reads a binary STL in the machine's byte order");

template <class Value>
Value value_at(std::string_view bytes, std::size_t at) {
  Value value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// CGAL welds vertices in a std::map, in which a NaN is equal to whatever it meets first.
void vet_binary(std::string& bytes, const std::string& name) {
  std::fill_n(bytes.begin(), header_size, '\0');  // where "solid" would have it read as text first
  for (std::size_t facet = 0, at = facets_at; at < bytes.size(); ++facet, at += facet_size)
    for (std::size_t k = 3; k < 12; ++k)  // behind the normal
      if (!is_finite(value_at<float>(bytes, at + k * sizeof(float))))
        throw InputError(fmt::format("{}: facet {} has a coordinate that is not finite", name, facet));
}

class AsciiVetter {
 public:
  AsciiVetter(std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  void run() {
    for_each_line(bytes_, [this](std::size_t begin, std::size_t end) {
      ++line_;
      vet(begin, end);
    });
    if (inside_ != Inside::nothing)
      throw InputError(fmt::format("{}: ends before 'endsolid'; the file is cut off", name_));
  }

 private:
  enum class Inside { nothing, solid, facet, loop };

  void vet(std::size_t begin, std::size_t end) {
    split_words(std::string_view(bytes_).substr(begin, end - begin), words_);
    if (words_.empty()) return;
    const std::string_view word = words_.front();
    if (word == "solid") {
      go(Inside::nothing, Inside::solid);
      return blank_rest(end);
    }
    if (word == "endsolid") {
      go(Inside::solid, Inside::nothing);
      return blank_rest(end);
    }
    if (word == "facet") {
      go(Inside::solid, Inside::facet);
      return blank_rest(end);  // the normal: CGAL takes none
    }
    if (word == "outer") {
      vertices_ = 0;
      go(Inside::facet, Inside::loop);
      return blank_rest(end);
    }
    if (word == "endloop") {
      if (vertices_ != 3) fail(fmt::format("a facet of {} vertices; STL has triangles only", vertices_));
      return go(Inside::loop, Inside::facet);
    }
    if (word == "endfacet") {
      if (vertices_ != 3) fail("a facet without 'outer loop'");
      vertices_ = 0;
      return go(Inside::facet, Inside::solid);
    }
    if (word == "vertex") return vet_vertex();
    fail(fmt::format("{} is no word that begins a line of an STL", quoted(word)));
  }

  void vet_vertex() {
    if (inside_ != Inside::loop) fail("a vertex outside of 'outer loop' and 'endloop'");
    ++vertices_;
    if (words_.size() != 4) fail("a vertex needs three coordinates: vertex x y z");
    for (std::size_t k = 1; k < 4; ++k)
      if (const std::string trouble = coordinate_trouble(words_[k]); !trouble.empty()) fail(trouble);
  }

  void go(Inside from, Inside to) {
    if (inside_ != from) fail(fmt::format("'{}' does not belong here", words_.front()));
    inside_ = to;
  }

  // A name may have words that CGAL would take for the file's.
  void blank_rest(std::size_t end) {
    const auto used = static_cast<std::size_t>(words_.front().data() + words_.front().size() - bytes_.data());
    std::fill(bytes_.begin() + static_cast<std::ptrdiff_t>(used), bytes_.begin() + static_cast<std::ptrdiff_t>(end),
              ' ');
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, what));
  }

  std::string& bytes_;
  const std::string& name_;
  std::vector<std::string_view> words_;
  std::size_t line_ = 0;
  int vertices_ = 0;
  Inside inside_ = Inside::nothing;
};

}  // namespace

std::string vetted_stl(std::string bytes, const std::string& name) {
  const bool has_count = bytes.size() >= facets_at;
  const std::uint64_t promised = has_count ? value_at<std::uint32_t>(bytes, header_size) : 0;
  if (has_count && bytes.size() == facets_at + promised * facet_size) {  // also where the header begins with "solid"
    vet_binary(bytes, name);
    return bytes;
  }
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\r\n\v\f"), bytes.size());
  if (std::string_view(bytes).substr(begin).starts_with("solid")) {
    AsciiVetter(bytes, name).run();
    return bytes;
  }
  if (!has_count)
    throw InputError(
        fmt::format("{}: is no STL: no text that begins with 'solid', and too short for a binary one", name));
  const auto needed = facets_at + promised * facet_size;
  throw InputError(fmt::format("{}: {} facets take {} bytes, the file has {}; it {}, or no STL", name, promised, needed,
                               bytes.size(), bytes.size() < needed ? "is cut off" : "goes on behind them"));
}

}  // namespace plumbline
