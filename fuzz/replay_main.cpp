// A libFuzzer target as a plain program: runs it once over each file named, and over the files of each folder.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

// The files of each folder in its place: the target is to run them, not to take the folder for its archive.
std::vector<std::string> with_files(int argc, char** argv) {
  std::vector<std::string> words;
  for (int i = 0; i < argc; ++i) {
    if (i == 0 || argv[i][0] == '-' || !fs::is_directory(argv[i])) {
      words.emplace_back(argv[i]);
      continue;
    }
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(argv[i]))
      if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    words.insert(words.end(), files.begin(), files.end());
  }
  return words;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words = with_files(argc, argv);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  int count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  argv = pointers.data();
  LLVMFuzzerInitialize(&count, &argv);
  std::size_t taken = 0;
  for (int i = 1; i < count; ++i) {
    std::ifstream in(argv[i], std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), {});
    if (!in) {
      std::fprintf(stderr, "%s: %s: cannot be read\n", argv[0], argv[i]);
      return 2;
    }
    taken += LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()) == 0;
  }
  std::printf("%zu of %d inputs are of the right size and were run\n", taken, count - 1);
  return count == 1 ? 2 : 0;
}
