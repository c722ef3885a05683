#include "case/case_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <unordered_map>

#include "case/enum_names.h"
#include "case/float_bits.h"
#include "case/input_error.h"
#include "case/input_file.h"
#include "case/nearest_name.h"
#include "case/place.h"
#include "case/real_text.h"

namespace plumbline {
namespace {

enum class Key : unsigned char { id, precision, triangle, ray, range, mode, aim, expect, known };
constexpr std::array<std::string_view, 9> key_names = {"case", "precision", "triangle", "ray",  "range",
                                                       "mode", "aim",       "expect",   "known"};
constexpr bool repeatable(Key key) { return key == Key::triangle || key == Key::known; }

constexpr std::string_view blanks = " \t\r\f\v";
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";  // some editors begin a file with it

// A word in a message. Whoever gives the wrong kind of file may give a long one.
std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  return word.size() <= longest ? fmt::format("'{}'", word) : fmt::format("'{}...'", word.substr(0, longest));
}

// The words of one line, taken from left to right; the place of an error is that of the word taken last.
class Words {
 public:
  Words(std::string_view line, Place place) : line_(line.substr(0, line.find('#'))), place_(place) { skip_blanks(); }

  bool empty() const { return at_ == line_.size(); }
  std::string_view peek() const { return line_.substr(at_, line_.find_first_of(blanks, at_) - at_); }

  std::string_view take(std::string_view what) {
    place_.column = at_ + 1;
    if (empty()) fail(place_, fmt::format("{} is missing", what));
    const std::string_view word = peek();
    at_ += word.size();
    skip_blanks();
    return word;
  }

  double take_number(std::string_view what) {
    const std::string_view word = take(what);
    const auto x = parse_real(word);
    if (!x) fail(place_, fmt::format("{} is no number ({}); write 0x1.8p+0, 1.5, inf or -inf", quoted(word), what));
    if (is_nan(*x)) fail(place_, fmt::format("a NaN ({}); write a number, inf or -inf", what));
    return *x;
  }

  double take_length(std::string_view what) {
    const double x = take_number(what);
    if (!(x >= 0) || !is_finite(x)) fail(place_, fmt::format("{} must be finite and not negative", what));
    return x;
  }

  template <class Enum, std::size_t N>
  Enum take_name(const std::array<std::string_view, N>& names, std::string_view what) {
    const std::string_view word = take(what);
    const auto value = from_name<Enum>(names, word);
    if (!value) fail(place_, fmt::format("unknown {} {}; {}", what, quoted(word), suggest(word, names)));
    return *value;
  }

  void expect_end() {
    if (empty()) return;
    place_.column = at_ + 1;
    fail(place_, fmt::format("{} is too much on this line; remove it, or put '#' before it", quoted(peek())));
  }

  const Place& place() const { return place_; }

 private:
  void skip_blanks() { at_ = std::min(line_.find_first_not_of(blanks, at_), line_.size()); }

  std::string_view line_;
  Place place_;
  std::size_t at_ = 0;
};

void read_mode(Words& words, Bag& bag) {
  bag.mode = words.take_name<BagMode>(bag_mode_names, "mode");
  enum class Part : unsigned char { thickness, position, cosine, orientation };
  constexpr std::array<std::string_view, 4> parts = {"thickness", "position", "cosine", "orientation"};
  constexpr std::array<std::string_view, 2> booleans = {"false", "true"};
  const bool plate = bag.mode == BagMode::plate;
  bool thick = false;
  while (!words.empty()) {
    const auto part = words.take_name<Part>(parts, "part of mode");
    if (!plate && part != Part::orientation)
      fail(words.place(),
           fmt::format("'{}' is of a plate; remove it, or write 'mode plate'", parts[static_cast<unsigned>(part)]));
    switch (part) {
      case Part::thickness:
        bag.thickness = words.take_length("thickness");
        thick = true;
        break;
      case Part::position:
        bag.position = words.take_name<PlatePosition>(plate_position_names, "position");
        break;
      case Part::cosine:
        bag.cosine = words.take_name<bool>(booleans, "cosine");
        break;
      case Part::orientation:
        bag.orientation = words.take_name<Orientation>(orientation_names, "orientation");
        break;
    }
  }
  if (plate && !thick) fail(words.place(), "a plate without thickness; add 'thickness 0.1'");
}

Aim read_aim(Words& words) {
  Aim aim;
  aim.target = words.take_name<TargetKind>(target_kind_names, "target");
  if (aim.target == TargetKind::tolerance) aim.tolerance = words.take_length("tolerance");
  enum class Part : unsigned char { standoff, wish };
  constexpr std::array<std::string_view, 2> parts = {"standoff", "wish"};
  while (!words.empty()) {
    switch (words.take_name<Part>(parts, "part of aim")) {
      case Part::standoff:
        aim.standoff = words.take_length("standoff");
        break;
      case Part::wish:
        aim.wish = words.take_name<Wish>(wish_names, "wish");
        break;
    }
  }
  return aim;
}

Expectation read_expectation(Words& words) {
  Expectation expect;
  expect.hit_class = words.take_name<HitClass>(hit_class_names, "class");
  enum class Part : unsigned char { hit, miss, t, u, v };
  constexpr std::array<std::string_view, 5> parts = {"hit", "miss", "t", "u", "v"};
  while (!words.empty()) {
    if (const auto feature = from_name<Feature>(feature_names, words.peek())) {
      expect.feature = *feature;
      words.take("feature");
      continue;
    }
    switch (words.take_name<Part>(parts, "part of expect")) {
      case Part::hit:
        expect.hit = true;
        break;
      case Part::miss:
        expect.hit = false;
        break;
      case Part::t:
        expect.t = words.take_number("t");
        break;
      case Part::u:
        expect.u = words.take_number("u");
        break;
      case Part::v:
        expect.v = words.take_number("v");
        break;
    }
  }
  return expect;
}

Known read_known(Words& words) {
  Known known;
  known.tracer = words.take("the tracer's name");
  known.kind = words.take_name<VerdictKind>(verdict_kind_names, "verdict");
  if (known.kind == VerdictKind::correct || known.kind == VerdictKind::unspecified)
    fail(words.place(), fmt::format("'{}' is no finding; write false-miss, false-hit, leak, wrong-nearest or fault",
                                    name(known.kind)));
  return known;
}

// Puts lines together into cases.
class CaseReader {
 public:
  explicit CaseReader(std::string_view file) : file_(file) {}

  void add_line(std::string_view line) {
    ++line_number_;
    if (line_number_ == 1 && line.starts_with(byte_order_mark)) line.remove_prefix(byte_order_mark.size());
    line = line.substr(0, line.find_last_not_of('\r') + 1);  // all: what is written must read back equal
    const auto start = line.find_first_not_of(blanks);
    if (start != line.npos && line[start] == '#') {
      line.remove_prefix(start + 1);
      comments_.emplace_back(line.substr(line.starts_with(' ')));
      return;
    }
    if (start != line.npos) add_keyed_line(Words(line, {file_, line_number_, 1}));
    comments_.clear();
  }

  std::vector<PlacedCase> finish() {
    finish_case();
    return std::move(cases_);
  }

 private:
  struct Number {
    double value;
    Place place;
  };

  void add_keyed_line(Words words) {
    if (words.peek().starts_with('{'))
      fail(words.place(), "this is JSON, and .case text is expected: lines 'case ID', 'triangle', 'ray'");
    const auto key = words.take_name<Key>(key_names, "key");
    const Place place = words.place();
    if (key == Key::id) {
      finish_case();
      open_ = place;
      cases_.push_back({.line = place.line, .what = {}});
      cases_.back().what.provenance = std::move(comments_);
    } else if (cases_.empty()) {
      fail(place, fmt::format("'{}' before any case; begin with a line 'case ID'", words_of(key)));
    }
    if (!repeatable(key) && seen_[index(key)])
      fail(place, fmt::format("a second '{}' in this case; remove one of them", words_of(key)));
    seen_.set(index(key));
    read_values(key, words, cases_.back().what);
    words.expect_end();
  }

  void read_values(Key key, Words& words, Case& into) {
    switch (key) {
      case Key::id:
        into.id = words.take("the case's id");
        check_new(into.id, words.place());
        break;
      case Key::precision:
        into.precision = words.take_name<Precision>(precision_names, "precision");
        break;
      case Key::triangle: {
        Triangle& triangle = into.bag.triangles.emplace_back();
        triangle.a = take_vector(words, "vertex a");
        triangle.b = take_vector(words, "vertex b");
        triangle.c = take_vector(words, "vertex c");
        break;
      }
      case Key::ray:
        into.ray.origin = take_vector(words, "ray origin");
        into.ray.direction = take_vector(words, "ray direction");
        break;
      case Key::range:
        into.ray.t_min = take_coordinate(words, "t_min");
        into.ray.t_max = take_coordinate(words, "t_max");
        break;
      case Key::mode:
        read_mode(words, into.bag);
        break;
      case Key::aim:
        into.aim = read_aim(words);
        break;
      case Key::expect:
        into.expect = read_expectation(words);
        break;
      case Key::known:
        into.known.push_back(read_known(words));
        break;
    }
  }

  void check_new(const std::string& id, const Place& place) {
    const auto [it, is_new] = line_of_.emplace(id, place.line);
    if (!is_new)
      fail(place, fmt::format("a second case '{}', the first is on line {}; rename one of them", id, it->second));
  }

  double take_coordinate(Words& words, std::string_view what) {
    const double x = words.take_number(what);
    numbers_.push_back({x, words.place()});
    return x;
  }

  Vec3 take_vector(Words& words, std::string_view what) {
    const double x = take_coordinate(words, fmt::format("{}, x", what));
    const double y = take_coordinate(words, fmt::format("{}, y", what));
    const double z = take_coordinate(words, fmt::format("{}, z", what));
    return {x, y, z};
  }

  void finish_case() {
    if (cases_.empty()) return;
    const Case& last = cases_.back().what;
    if (!seen_[index(Key::triangle)])
      fail(open_, fmt::format("case '{}' has no triangle; add a line 'triangle' and 9 numbers", last.id));
    if (!seen_[index(Key::ray)])
      fail(open_, fmt::format("case '{}' has no ray; add a line 'ray' and 6 numbers", last.id));
    if (last.precision == Precision::binary32) {
      for (const Number& number : numbers_) {
        if (is_binary32(number.value)) continue;
        fail(number.place,
             fmt::format("{} is no binary32 number; round it, or write 'precision binary64'", hexfloat(number.value)));
      }
    }
    seen_.reset();
    numbers_.clear();
  }

  static std::size_t index(Key key) { return static_cast<std::size_t>(key); }
  static std::string_view words_of(Key key) { return key_names[index(key)]; }

  std::string_view file_;
  std::size_t line_number_ = 0;
  std::vector<std::string> comments_;  // those directly above the line at hand
  std::vector<PlacedCase> cases_;
  std::unordered_map<std::string, std::size_t> line_of_;  // by id
  // Of the last case, which is still open:
  Place open_;
  std::bitset<key_names.size()> seen_;
  std::vector<Number> numbers_;
};

void append_numbers(std::string& out, std::initializer_list<double> numbers) {
  for (const double x : numbers) {
    out += ' ';
    append_hexfloat(out, x);
  }
}

void append_vector(std::string& out, const Vec3& v) { append_numbers(out, {v.x, v.y, v.z}); }

void append_number(std::string& out, std::string_view key, const std::optional<double>& x) {
  if (!x) return;
  out += key;
  append_numbers(out, {*x});
}

std::vector<Case> without_places(std::vector<PlacedCase> placed) {
  std::vector<Case> cases;
  cases.reserve(placed.size());
  for (PlacedCase& one : placed) cases.push_back(std::move(one.what));
  return cases;
}

}  // namespace

std::vector<Case> read_cases(const std::string& path) { return without_places(read_placed_cases(path)); }

std::vector<PlacedCase> read_placed_cases(const std::string& path) {
  InputFile file(path);
  CaseReader reader(file.name());
  for (std::string_view line; file.next_line(line);) reader.add_line(line);
  return reader.finish();
}

std::vector<Case> parse_cases(std::string_view text, std::string_view name) {
  CaseReader reader(name);
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    reader.add_line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return without_places(reader.finish());
}

std::string to_text(const Case& what) {
  std::string out;
  for (const std::string& line : what.provenance) out += line.empty() ? "#\n" : fmt::format("# {}\n", line);
  out += fmt::format("case {}\nprecision {}\n", what.id, name(what.precision));
  for (const Triangle& triangle : what.bag.triangles) {
    out += "triangle";
    append_vector(out, triangle.a);
    out += "  ";
    append_vector(out, triangle.b);
    out += "  ";
    append_vector(out, triangle.c);
    out += '\n';
  }
  out += "ray";
  append_vector(out, what.ray.origin);
  out += "  ";
  append_vector(out, what.ray.direction);
  out += "\nrange";
  append_numbers(out, {what.ray.t_min, what.ray.t_max});
  out += '\n';
  if (const Bag& bag = what.bag; bag != Bag{.triangles = bag.triangles}) {
    out += fmt::format("mode {}", name(bag.mode));
    if (bag.mode == BagMode::plate)
      out +=
          fmt::format(" thickness {} position {} cosine {}", hexfloat(bag.thickness), name(bag.position), bag.cosine);
    out += fmt::format(" orientation {}\n", name(bag.orientation));
  }
  if (what.aim) {
    out += fmt::format("aim {}", name(what.aim->target));
    append_number(out, "", what.aim->tolerance);
    append_number(out, " standoff", what.aim->standoff);
    out += fmt::format(" wish {}\n", name(what.aim->wish));
  }
  if (what.expect) {
    out += fmt::format("expect {}", name(what.expect->hit_class));
    if (what.expect->feature != Feature::none) out += fmt::format(" {}", name(what.expect->feature));
    if (what.expect->hit) out += *what.expect->hit ? " hit" : " miss";
    append_number(out, " t", what.expect->t);
    append_number(out, " u", what.expect->u);
    append_number(out, " v", what.expect->v);
    out += '\n';
  }
  for (const Known& known : what.known) out += fmt::format("known {} {}\n", known.tracer, name(known.kind));

  const auto back = parse_cases(out, fmt::format("case '{}' as text", what.id));
  if (back.size() == 1 && back.front() == what) return out;
  throw InputError(
      fmt::format("case '{}' cannot be written as text; its id must be one word without '#', its provenance "
                  "free of newlines, and only a plate may have thickness, position and cosine",
                  what.id));
}

}  // namespace plumbline
