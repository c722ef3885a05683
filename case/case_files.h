// Which .case files a path means, and what is in them to be judged.
#pragma once
#include <string>
#include <vector>

#include "case/case_text.h"

namespace plumbline {

/// A file: itself. A folder: the *.case in it, at any depth, sorted; throws InputError if there is none.
std::vector<std::string> case_files(const std::string& path);

/// The cases of a file, of which each is to be judged. Throws InputError as read_cases does, where there is none, and
/// where one can't be judged: several triangles that aren't surfaces, or with a line `expect`, which is of one.
std::vector<PlacedCase> cases_to_judge(const std::string& file);

}  // namespace plumbline
