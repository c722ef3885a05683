#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "case/input_error.h"
#include "mesh/mesh_words.h"
#include "mesh/vetted.h"

namespace plumbline {
namespace {

// Of OBJ's keywords those that make no face: normals, textures, points, lines, curves, surfaces, groups, materials.
constexpr std::array<std::string_view, 42> left_out = {
    "vt",     "vn",     "vp",     "deg",    "bmat",       "step",      "cstype",   "p",        "l",
    "curv",   "curv2",  "surf",   "parm",   "trim",       "hole",      "scrv",     "sp",       "end",
    "con",    "g",      "s",      "mg",     "o",          "bevel",     "c_interp", "d_interp", "lod",
    "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj", "ctech",    "stech",    "bsp",
    "bzp",    "cdc",    "cdp",    "res",    "call",       "csh"};

class ObjVetter {
 public:
  ObjVetter(std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  void run() {
    for_each_line(bytes_, [this](std::size_t begin, std::size_t end) {
      ++line_;
      vet(begin, end);
    });
    if (!any_face_) throw InputError(fmt::format("{}: has no face", name_));
    if (highest_ > vertices_)
      throw InputError(fmt::format("{}:{}: vertex {} of {}; the file has too few, is it cut off?", name_,
                                   highest_line_, highest_, vertices_));
  }

 private:
  // CGAL takes single blanks between the words of a face.
  void vet(std::size_t begin, std::size_t end) {
    const auto of = [this](std::size_t at) { return bytes_.begin() + static_cast<std::ptrdiff_t>(at); };
    const std::string_view line = std::string_view(bytes_).substr(begin, end - begin);
    const std::size_t comment = begin + std::min(line.find('#'), line.size());
    std::fill(of(comment), of(end), ' ');
    std::replace_if(
        of(begin), of(comment), [](char c) { return mesh_blanks.find(c) != mesh_blanks.npos; }, ' ');
    split_words(line.substr(0, comment - begin), words_);
    if (words_.empty()) return;
    if (words_.back().ends_with('\\')) fail("a line that goes on in the next is not read; join the two");
    if (words_.front() == "v") return vet_vertex();
    if (words_.front() == "f") return vet_face();
    if (std::ranges::find(left_out, words_.front()) == left_out.end())
      fail(fmt::format("{} is no keyword of OBJ", quoted(words_.front())));
    std::fill(of(begin), of(end), ' ');
  }

  void vet_vertex() {
    ++vertices_;
    if (words_.size() < 4) fail("a vertex needs three coordinates: v x y z");
    for (std::size_t k = 1; k < 4; ++k)
      if (const std::string trouble = coordinate_trouble(words_[k]); !trouble.empty()) fail(trouble);
  }

  void vet_face() {
    any_face_ = true;
    if (words_.size() < 4) fail("a face needs three vertices or more");
    for (std::size_t k = 1; k < words_.size(); ++k) {
      const std::string_view word = words_[k];
      std::int32_t index = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
      const std::string_view rest = word.substr(static_cast<std::size_t>(end - word.data()));
      if (error != std::errc{} || !(rest.empty() || rest.starts_with('/')) ||
          rest.find_first_not_of("/-0123456789") != rest.npos)
        fail(fmt::format("{} is no vertex of a face; write v, v/vt, v//vn or v/vt/vn", quoted(word)));
      if (index == 0) fail("vertex 0: OBJ counts from 1");
      if (index < 0 && -std::int64_t{index} > vertices_)
        fail(fmt::format("vertex {}: there are {} before this line", index, vertices_));
      if (index > highest_) {
        highest_ = index;
        highest_line_ = line_;
      }
    }
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, what));
  }

  std::string& bytes_;
  const std::string& name_;
  std::vector<std::string_view> words_;
  std::size_t line_ = 0, highest_line_ = 0;
  std::int64_t vertices_ = 0, highest_ = 0;
  bool any_face_ = false;
};

}  // namespace

std::string vetted_obj(std::string bytes, const std::string& name) {
  ObjVetter(bytes, name).run();
  return bytes;
}

}  // namespace plumbline
