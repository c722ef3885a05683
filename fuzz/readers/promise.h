// What the fuzz targets of our readers hold them to: any bytes give an InputError of one line, or a value whose
// written form reads back equal. Whatever else happens, a death, a leak, gigabytes, libFuzzer and the sanitizers see.
#pragma once
#include <string_view>

#include "case/input_error.h"

namespace plumbline {

/// Prints what was broken, and aborts.
[[noreturn]] void broken(std::string_view what);

/// Holds the message to one printable line.
void check_message(const InputError& error);

/// Whether `read` threw InputError.
template <class Read>
bool refused(Read read) {
  try {
    read();
    return false;
  } catch (const InputError& error) {
    check_message(error);
    return true;
  }
}

/// Of a reader that has to take what was written.
template <class Read>
auto reread(Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    broken(error.what());
  }
}

}  // namespace plumbline
