#pragma once

#include <initializer_list>

#include "rest/json_schema.h"

namespace vsplit::rest {

/// Header fields as OpenAPI describes them: components/parameters of requests and components/headers of answers, each once.

[[nodiscard]] Json header_parameters();
[[nodiscard]] Json header_components();

/// References to parameters that every request may have, and those of a request for a file beside them.
[[nodiscard]] Json common_parameters();
[[nodiscard]] Json file_parameters();

/// "headers" of an answer: what all have, and of the others those whose keys in header_components are named here.
[[nodiscard]] Json headers_of(std::initializer_list<const char*> keys = {});

}  // namespace vsplit::rest
