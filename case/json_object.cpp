#include "case/json_object.h"

#include "case/float_bits.h"
#include "case/real_text.h"

namespace plumbline {

JsonObject::JsonObject(std::string& out) : out_(out) { out_ += '{'; }

void JsonObject::number(std::string_view key, std::optional<double> x) {
  std::string& out = member(key);
  if (x) {
    append_json_number(out, *x);
  } else {
    out += "null";
  }
}

void JsonObject::boolean(std::string_view key, std::optional<bool> x) {
  member(key) += !x ? "null" : *x ? "true" : "false";
}

void JsonObject::text(std::string_view key, std::optional<std::string_view> x) {
  std::string& out = member(key);
  if (x) {
    append_json_string(out, *x);
  } else {
    out += "null";
  }
}

std::string& JsonObject::member(std::string_view key) {
  if (!empty_) out_ += ',';
  empty_ = false;
  append_json_string(out_, key);
  out_ += ':';
  return out_;
}

void JsonObject::end() { out_ += '}'; }

void JsonObject::end_line() { out_ += "}\n"; }

void append_json_number(std::string& out, double x) {
  if (is_finite(x)) return append_shortest_decimal(out, x);
  out += '"';
  append_shortest_decimal(out, x);
  out += '"';
}

void append_json_string(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\t':
        out += "\\t";
        break;
      case '\r':
        out += "\\r";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20) {
          out += c;
        } else {
          constexpr std::string_view digits = "0123456789abcdef";
          out += "\\u00";
          out += digits[static_cast<unsigned char>(c) >> 4];
          out += digits[static_cast<unsigned char>(c) & 15];
        }
    }
  }
  out += '"';
}

}  // namespace plumbline
