// Unfinished files don't outlive the program: a signal that ends it (SIGINT, SIGTERM, SIGHUP) removes them first.
#pragma once

namespace plumbline {

/// Has `path` removed on such a signal. The text has to stay where it is until keep_on_signal. At most 16 at a time; of
/// more, the rest are left behind.
void remove_on_signal(const char* path);

/// The file is finished, or gone.
void keep_on_signal(const char* path);

}  // namespace plumbline
