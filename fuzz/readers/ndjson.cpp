// Lines of NDJSON: cases, with an answer or without, as `judge -` reads them, from a file in memory.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "case/case_json.h"
#include "case/case_lines.h"
#include "fuzz/readers/promise.h"

namespace plumbline {
namespace {

class MemoryFile {
 public:
  MemoryFile()
      : descriptor_(memfd_create("lines", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(descriptor_)) {}

  const std::string& with(std::string_view bytes) const {
    if (ftruncate(descriptor_, 0) != 0 ||
        pwrite(descriptor_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
      broken("no memory to write to");
    return path_;
  }

 private:
  int descriptor_;
  std::string path_;
};

std::string written(const CaseLine& line) {
  std::string out;
  JsonObject object(out);
  const bool has_id = !line.asked.id.empty() || line.id != "null";
  if (has_id) object.member("id") += line.id;
  add_members(object, line.asked);
  if (line.answer) add_members(object, *line.answer);
  object.text("tracer", line.tracer);
  object.end_line();
  return out;
}

void check_same(const CaseLine& line, const CaseLine& again) {
  if (written(again) != written(line)) broken("a line that is written in two ways");
  const bool has_nan = line.asked != line.asked;
  if (!has_nan && again.asked != line.asked) broken("a case that reads back as another");
  if (again.answer.has_value() != line.answer.has_value() || again.tracer != line.tracer || again.id != line.id)
    broken("an answer that reads back as another");
}

void run(std::string_view bytes) {
  static const MemoryFile file, copy;
  std::vector<CaseLine> read;
  refused([&] {
    CaseLines lines(file.with(bytes));
    for (CaseLine line; lines.next(line);) read.push_back(line);
  });
  if (read.empty()) return;
  std::string text;
  for (const CaseLine& line : read) text += written(line);
  CaseLines lines(copy.with(text));
  for (const CaseLine& line : read) {
    CaseLine again;
    if (!reread([&] { return lines.next(again); })) broken("a line that is lost");
    check_same(line, again);
  }
}

}  // namespace
}  // namespace plumbline

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumbline::run({reinterpret_cast<const char*>(data), size});
  return 0;
}
