#include "ops/page.h"

namespace vsplit::ops {

rest::Pages page_files() { return {}; }

}  // namespace vsplit::ops
