// The message of the InputError that a call throws; empty if it throws none.
#pragma once
#include <string>

#include "case/input_error.h"

namespace plumbline {

template <class Call>
std::string error_of(Call call) {
  try {
    call();
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace plumbline
