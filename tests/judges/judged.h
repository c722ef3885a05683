// What an independent judge says of a case.
#pragma once
#include "oracle/truth.h"

namespace plumbline::judges {

struct Judged {
  Truth truth;
  bool touches = false;  ///< as contact.h; false where the class is neither coplanar nor degenerate
};

}  // namespace plumbline::judges
