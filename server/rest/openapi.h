#pragma once

#include <string>
#include <string_view>

#include "rest/router.h"
#include "rest/schema.h"

namespace vsplit::rest {

/// The OpenAPI 3.1 document of what the routes offer, made of descriptors and their comments. O(schema).
[[nodiscard]] std::string openapi_document(const Schema& schema, const Router& router, std::string_view version);

}  // namespace vsplit::rest
