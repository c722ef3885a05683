// Writes one JSON object, member after member, onto the end of a string. Numbers are shortest round-trip decimals;
// those that JSON has no number for are the strings "inf", "-inf" and "nan".
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace plumbline {

class JsonObject {
 public:
  explicit JsonObject(std::string& out);

  /// No value: null.
  void number(std::string_view key, std::optional<double> x);
  void boolean(std::string_view key, std::optional<bool> x);
  void text(std::string_view key, std::optional<std::string_view> x);
  /// For any other value: append its JSON to what is returned.
  std::string& member(std::string_view key);
  void end();
  /// Ends the object, and the line.
  void end_line();

 private:
  std::string& out_;
  bool empty_ = true;
};

/// Appends a number, or the string that stands for it.
void append_json_number(std::string& out, double x);

/// Appends a string in quotes, escaped.
void append_json_string(std::string& out, std::string_view text);

}  // namespace plumbline
