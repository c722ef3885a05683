// The forms in which a file holds cases, and reading any of them.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"
#include "case/case_bytes.h"

namespace plumbline {

enum class CaseForm : unsigned char {
  text,    ///< .case
  ndjson,  ///< .ndjson or .jsonl, and standard input
  bytes,   ///< any other name: a fuzzer's input, one a file
};
inline constexpr std::array<std::string_view, 3> case_form_names = {"case", "ndjson", "bytes"};
constexpr std::string_view name(CaseForm f) { return case_form_names[static_cast<unsigned>(f)]; }

/// By the file's name; "-" is standard input.
CaseForm form_of(const std::string& path);

/// A file, or "-": itself. A folder: all files in it, at any depth, sorted. Throws InputError if there is none.
std::vector<std::string> files_of(const std::string& path);

/// How bytes are read. Their number tells space and precision; what is given here has to agree with it.
struct BytesReading {
  std::optional<Space> space;
  std::optional<Precision> precision;
  Domain domain = Domain::nominal;
};

/// take(case) for each case of the file. The id of a case from bytes is the file's name. Throws InputError.
void read_any_cases(const std::string& path, const BytesReading& reading,
                    const std::function<void(const Case&)>& take);

}  // namespace plumbline
