#include "case/case_lines.h"

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <bitset>

#include "case/enum_names.h"
#include "case/float_bits.h"
#include "case/input_file.h"
#include "case/nearest_name.h"
#include "case/place.h"
#include "case/real_text.h"

namespace plumbline {
namespace {

namespace ondemand = simdjson::ondemand;
static_assert(InputFile::padding >= simdjson::SIMDJSON_PADDING);

// clang-format off
enum class Key : unsigned char {
  id, triangle, triangles, precision, origin, direction, t_min, t_max,  // what is asked
  mode, thickness, position, cosine, orientation,                       // of the bag
  target, tolerance, standoff, wish,                                    // how the ray was aimed
  hit, t, u, v, in, out, triangle_index, fault, tracer                  // the answer
};
constexpr std::array<std::string_view, 26> key_names = {
  "id", "triangle", "triangles", "precision", "origin", "direction", "t_min", "t_max",
  "mode", "thickness", "position", "cosine", "orientation",
  "target", "tolerance", "standoff", "wish",
  "hit", "t", "u", "v", "in", "out", "triangle_index", "fault", "tracer"};
// clang-format on

class Keys {
 public:
  void add(Key key) { seen_.set(static_cast<std::size_t>(key)); }
  bool has(Key key) const { return seen_[static_cast<std::size_t>(key)]; }
  bool has_any(std::initializer_list<Key> keys) const {
    return std::ranges::any_of(keys, [this](Key key) { return has(key); });
  }

 private:
  std::bitset<key_names.size()> seen_;
};

std::string_view name(Key key) { return key_names[static_cast<std::size_t>(key)]; }

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";  // some editors begin a file with it

std::string_view trimmed(std::string_view text) { return text.substr(0, text.find_last_not_of(" \t\r\n") + 1); }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The grammar of RFC 8259, which is narrower than parse_real's: no .5, 5. or 0x1p+0.
bool is_json_number(std::string_view text) {
  std::size_t at = text.starts_with('-') ? 1 : 0;
  const auto skip_digits = [&] {
    const std::size_t start = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at - start;
  };
  const bool zero = text.substr(at).starts_with('0');
  const std::size_t digits = skip_digits();
  if (digits == 0 || (zero && digits > 1)) return false;
  if (at < text.size() && text[at] == '.') {
    ++at;
    if (skip_digits() == 0) return false;
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (skip_digits() == 0) return false;
  }
  return at == text.size();
}

// Reads one line after another; the lines' memory is the caller's, with the padding behind each.
class LineReader {
 public:
  explicit LineReader(std::string name) : name_(std::move(name)) {}

  void read_case(std::string_view text, std::size_t line_number, CaseLine& into) {
    read(text, line_number, into);
    check_question(into.asked);
    if (is_answered()) into.answer = answer();
  }

  void read_answer(std::string_view text, std::size_t line_number, CaseLine& into) {
    read(text, line_number, into);
    into.answer = answer();
  }

  [[noreturn]] void fail_at(const char* where, std::string_view message) const {
    const auto column = static_cast<std::size_t>(where - text_.data()) + 1;
    plumbline::fail({name_, line_number_, std::min(column, text_.size() + 1)}, message);
  }
  [[noreturn]] void fail_at_start(std::string_view message) const { fail_at(text_.data(), message); }

 private:
  // An answer, member by member.
  struct Parts {
    Outcome outcome = Outcome::miss;
    bool fault = false;
    std::optional<double> t, u, v, in, out;
    std::uint32_t triangle = 0;
  };

  void read(std::string_view text, std::size_t line_number, CaseLine& into) {
    text_ = text;
    line_number_ = line_number;
    auto triangles = std::move(into.asked.bag.triangles);  // keeps its memory
    triangles.clear();
    into = {};
    into.asked.bag.triangles = std::move(triangles);
    keys_ = {};
    parts_ = {};

    const auto error = parser_.iterate(text_, text_.size() + InputFile::padding).get(document_);
    if (error) malformed(error, end_of_line());
    for (auto field : need(document_.get_object())) read_field(need(field), into);
    const char* rest = nullptr;
    if (!document_.current_location().get(rest))
      fail_at(rest, "more follows the object; put each object on a line of its own");
  }

  bool is_answered() const {
    return keys_.has_any({Key::hit, Key::t, Key::u, Key::v, Key::in, Key::out, Key::fault});
  }

  void read_field(ondemand::field field, CaseLine& into) {
    const char* const where = field.key().raw() - 1;
    const std::string_view word = need(field.unescaped_key());
    const auto key = from_name<Key>(key_names, word);
    if (!key) fail_at(where, fmt::format("unknown key '{}'; {}", word, suggest(word, key_names)));
    if (keys_.has(*key)) fail_at(where, fmt::format("a second '{}' in this object; remove one of them", word));
    keys_.add(*key);
    key_ = *key;
    read_value(field.value(), into);
  }

  void read_value(ondemand::value value, CaseLine& into) {
    Case& asked = into.asked;
    const auto aim = [&]() -> Aim& { return asked.aim ? *asked.aim : asked.aim.emplace(); };
    switch (key_) {
      case Key::id:
        read_id(value, into);
        break;
      case Key::triangle:
        asked.bag.triangles.push_back(triangle(value));
        break;
      case Key::triangles:
        for (auto element : array(value)) asked.bag.triangles.push_back(triangle(need(element)));
        break;
      case Key::precision:
        asked.precision = word<Precision>(value, precision_names);
        break;
      case Key::origin:
        asked.ray.origin = vector(value);
        break;
      case Key::direction:
        asked.ray.direction = vector(value);
        break;
      case Key::t_min:
        asked.ray.t_min = number(value);
        break;
      case Key::t_max:
        asked.ray.t_max = number_or_null(value).value_or(asked.ray.t_max);
        break;
      case Key::mode:
        asked.bag.mode = word<BagMode>(value, bag_mode_names);
        break;
      case Key::thickness:
        asked.bag.thickness = length(value);
        break;
      case Key::position:
        asked.bag.position = word<PlatePosition>(value, plate_position_names);
        break;
      case Key::cosine:
        asked.bag.cosine = boolean(value);
        break;
      case Key::orientation:
        asked.bag.orientation = word<Orientation>(value, orientation_names);
        break;
      case Key::target:
        aim().target = word<TargetKind>(value, target_kind_names);
        break;
      case Key::tolerance:
        aim().tolerance = is_null(value) ? std::nullopt : std::optional(length(value));
        break;
      case Key::standoff:
        aim().standoff = length(value);
        break;
      case Key::wish:
        aim().wish = word<Wish>(value, wish_names);
        break;
      case Key::hit:
        parts_.outcome = outcome(value);
        break;
      case Key::fault:
        parts_.fault = boolean(value);
        break;
      case Key::t:
        parts_.t = number_or_null(value);
        break;
      case Key::u:
        parts_.u = number_or_null(value);
        break;
      case Key::v:
        parts_.v = number_or_null(value);
        break;
      case Key::in:
        parts_.in = number_or_null(value);
        break;
      case Key::out:
        parts_.out = number_or_null(value);
        break;
      case Key::triangle_index:
        parts_.triangle = whole_number(value);
        break;
      case Key::tracer:
        into.tracer = string(value);
        break;
    }
  }

  // What only the whole line can tell.
  void check_question(const Case& asked) const {
    if (keys_.has(Key::triangle) && keys_.has(Key::triangles))
      fail_at_start("both 'triangle' and 'triangles'; remove one of them");
    if (asked.bag.triangles.empty()) fail_at_start("no triangle; add \"triangle\":[[x,y,z],[x,y,z],[x,y,z]]");
    for (const Key key : {Key::origin, Key::direction})
      if (!keys_.has(key)) fail_at_start(fmt::format("key '{0}' is missing; add \"{0}\":[x,y,z]", name(key)));
    const bool plate = asked.bag.mode == BagMode::plate;
    if (plate && !keys_.has(Key::thickness)) fail_at_start("a plate without 'thickness'; add \"thickness\":0.1");
    if (!plate && keys_.has_any({Key::thickness, Key::position, Key::cosine}))
      fail_at_start("'thickness', 'position' and 'cosine' are of a plate; add \"mode\":\"plate\", or remove them");
    if (asked.aim && !keys_.has(Key::target))
      fail_at_start("'tolerance', 'standoff' and 'wish' need a 'target'; add \"target\":\"interior\"");
    if (asked.precision == Precision::binary32) check_binary32(asked);
  }

  void check_binary32(const Case& asked) const {
    const auto check = [this](double x) {
      if (!is_binary32(x))
        fail_at_start(fmt::format("{} is no binary32 number; round it, or leave out 'precision'", shortest_decimal(x)));
    };
    const auto check_vector = [&](const Vec3& p) { check(p.x), check(p.y), check(p.z); };
    for (const Triangle& t : asked.bag.triangles) check_vector(t.a), check_vector(t.b), check_vector(t.c);
    check_vector(asked.ray.origin), check_vector(asked.ray.direction);
    check(asked.ray.t_min), check(asked.ray.t_max);
  }

  Answer answer() const {
    if (!keys_.has(Key::hit)) fail_at_start("an answer without 'hit'; add \"hit\":true, false, or null for a fault");
    Answer said{.outcome = parts_.outcome, .triangle = parts_.triangle};
    if (parts_.fault) said.outcome = Outcome::fault;
    if (said.outcome != Outcome::hit) return said;
    said.has_t = parts_.t.has_value();
    said.t = parts_.t.value_or(0);
    if (parts_.u && parts_.v) said.has_uv = true, said.u = *parts_.u, said.v = *parts_.v;
    if (parts_.in && parts_.out) said.has_segment = true, said.in = *parts_.in, said.out = *parts_.out;
    return said;
  }

  // Values. Scalars are read from their own text, so that one reader of numbers serves all; simdjson steps over them.

  static std::string_view token(ondemand::value value) { return trimmed(value.raw_json_token()); }
  static bool is_null(ondemand::value value) { return token(value) == "null"; }

  double number(ondemand::value value) {
    const std::string_view text = token(value);
    const bool quoted = text.starts_with('"');
    const auto x = quoted ? parse_real(string(value)) : is_json_number(text) ? parse_real(text) : std::nullopt;
    if (!x) wrong(text, R"(a number, or a string with a hexfloat, "inf", "-inf" or "nan")");
    return *x;
  }

  std::optional<double> number_or_null(ondemand::value value) {
    return is_null(value) ? std::nullopt : std::optional(number(value));
  }

  double length(ondemand::value value) {
    const double x = number(value);
    if (!(x >= 0) || !is_finite(x)) wrong(token(value), "a finite number that is not negative");
    return x;
  }

  std::uint32_t whole_number(ondemand::value value) {
    const double x = number(value);
    if (!(x >= 0 && x < 0x1p32) || x != static_cast<std::uint32_t>(x)) wrong(token(value), "a whole number from 0");
    return static_cast<std::uint32_t>(x);
  }

  bool boolean(ondemand::value value) {
    const std::string_view text = token(value);
    if (text != "true" && text != "false") wrong(text, "true or false");
    return text == "true";
  }

  Outcome outcome(ondemand::value value) {
    const std::string_view text = token(value);
    if (text != "true" && text != "false" && text != "null") wrong(text, "true, false or null");
    return text == "true" ? Outcome::hit : text == "false" ? Outcome::miss : Outcome::fault;
  }

  std::string_view string(ondemand::value value) {
    const std::string_view text = token(value);
    if (!text.starts_with('"')) wrong(text, "a string");
    return need(value.get_string());
  }

  template <class Enum, std::size_t N>
  Enum word(ondemand::value value, const std::array<std::string_view, N>& names) {
    const std::string_view text = token(value);
    const std::string_view said = string(value);
    const auto found = from_name<Enum>(names, said);
    if (!found) fail_at(text.data(), fmt::format("unknown {} '{}'; {}", name(key_), said, suggest(said, names)));
    return *found;
  }

  ondemand::array array(ondemand::value value) {
    const std::string_view text = token(value);
    if (!text.starts_with('[')) wrong(text, "an array");
    return need(value.get_array());
  }

  template <class Element, class Read>
  std::array<Element, 3> three(ondemand::value value, Read read, std::string_view what) {
    const char* const where = token(value).data();
    std::array<Element, 3> elements;
    std::size_t count = 0;
    for (auto element : array(value)) {
      if (count == 3) fail_at(where, fmt::format("key '{}': more than 3 {}", name(key_), what));
      elements[count++] = read(need(element));
    }
    if (count < 3) fail_at(where, fmt::format("key '{}': {} of 3 {}", name(key_), count, what));
    return elements;
  }

  Vec3 vector(ondemand::value value) {
    const auto [x, y, z] = three<double>(
        value, [this](ondemand::value v) { return number(v); }, "numbers");
    return {x, y, z};
  }

  Triangle triangle(ondemand::value value) {
    const auto [a, b, c] = three<Vec3>(
        value, [this](ondemand::value v) { return vector(v); }, "vertices");
    return {a, b, c};
  }

  void read_id(ondemand::value value, CaseLine& into) {
    const std::string_view text = token(value);
    into.id = text;
    if (text.starts_with('"')) {
      into.asked.id = string(value);
    } else {
      if (!is_json_number(text) && text != "true" && text != "false" && text != "null")
        wrong(text, "a string, number, true, false or null");
      into.asked.id = text;
    }
  }

  [[noreturn]] void wrong(std::string_view text, std::string_view expected) const {
    const char first = text.empty() ? ' ' : text[0];
    const std::string_view said = first == '[' ? "an array" : first == '{' ? "an object" : text.substr(0, 40);
    fail_at(text.data(), fmt::format("key '{}': expected {}, not {}", name(key_), expected, said));
  }

  template <class T>
  T need(simdjson::simdjson_result<T> result) {
    T value;
    if (const auto error = std::move(result).get(value)) {
      const char* where = nullptr;
      const bool ended = error == simdjson::INCOMPLETE_ARRAY_OR_OBJECT;
      malformed(error, ended || document_.current_location().get(where) ? end_of_line() : where);
    }
    return value;
  }

  [[noreturn]] void malformed(simdjson::error_code error, const char* where) const {
    fail_at(where, error == simdjson::INCORRECT_TYPE
                       ? "not a JSON object; each line is one, in braces"
                       : fmt::format("malformed JSON: {}", simdjson::error_message(error)));
  }

  const char* end_of_line() const { return text_.data() + trimmed(text_).size(); }

  const std::string name_;  // of the file, for messages
  ondemand::parser parser_;
  ondemand::document document_;
  // Of the line at hand:
  std::string_view text_;
  std::size_t line_number_ = 0;
  Keys keys_;
  Key key_ = Key::id;
  Parts parts_;
};

}  // namespace

class CaseLines::Impl {
 public:
  explicit Impl(const std::string& path) : file_(path), reader_(file_.name()) {}

  bool next(CaseLine& into) {
    std::string_view text;
    do {
      if (!file_.next_line(text)) return false;
      if (file_.line_number() == 1 && text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    } while (trimmed(text).empty());
    reader_.read_case(text, file_.line_number(), into);
    return true;
  }

  bool ready() { return file_.line_ready(); }

  [[noreturn]] void fail(std::string_view message) const { reader_.fail_at_start(message); }

 private:
  InputFile file_;
  LineReader reader_;
};

CaseLines::CaseLines(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
CaseLines::~CaseLines() = default;
bool CaseLines::next(CaseLine& line) { return impl_->next(line); }
bool CaseLines::ready() { return impl_->ready(); }
void CaseLines::fail(std::string_view message) const { impl_->fail(message); }

namespace {

// Lines from anywhere, copied to where the parser may read on.
class PaddedReader {
 public:
  explicit PaddedReader(std::string name) : reader_(std::move(name)) {}

  const CaseLine& read(std::string_view text, void (LineReader::*as)(std::string_view, std::size_t, CaseLine&)) {
    text_.assign(text);
    text_.reserve(text_.size() + InputFile::padding);
    (reader_.*as)(text_, ++line_number_, line_);
    return line_;
  }

 private:
  LineReader reader_;
  std::string text_;
  std::size_t line_number_ = 0;
  CaseLine line_;
};

}  // namespace

class CaseObjects::Impl : public PaddedReader {
  using PaddedReader::PaddedReader;
};

CaseObjects::CaseObjects(std::string name) : impl_(std::make_unique<Impl>(std::move(name))) {}
CaseObjects::~CaseObjects() = default;
Case CaseObjects::read(std::string_view object) { return impl_->read(object, &LineReader::read_case).asked; }

class AnswerReader::Impl : public PaddedReader {
  using PaddedReader::PaddedReader;
};

AnswerReader::AnswerReader(std::string name) : impl_(std::make_unique<Impl>(std::move(name))) {}
AnswerReader::~AnswerReader() = default;
AnswerLine AnswerReader::read(std::string_view line) {
  const CaseLine& said = impl_->read(line, &LineReader::read_answer);
  return {said.id, *said.answer};
}

}  // namespace plumbline
