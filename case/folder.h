// Folders that results go to.
#pragma once
#include <filesystem>

namespace plumbline {

/// Made, with those on the way there, unless it is there. Throws InputError, naming it, where that can't be.
void make_folder(const std::filesystem::path& folder);

}  // namespace plumbline
