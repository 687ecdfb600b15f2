#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>
#include <vector>

#include "rest/path_template.h"
#include "rest/schema.h"
#include "vsplit/base/expected.h"

namespace vsplit::rest {

/// One HTTP method and path of an rpc.
struct Route {
    std::string method;  ///< "GET"
    PathTemplate path;
    std::string body;  ///< the request's field that the body is; "*" for all of it, empty for no body
    const google::protobuf::MethodDescriptor* rpc = nullptr;
};

/// Routes from the google.api.http annotations of a schema's rpcs: the one place that says which path leads where. An rpc without
/// an annotation is reached by gRPC only.
class Router {
public:
    /// `schema` must outlive the router. \return MALFORMED_INPUT naming the rpc whose annotation is at fault.
    [[nodiscard]] static Expected<Router> make(const Schema& schema);

    /// Those of the most specific template that fits, one a method; none when none does. O(routes * path).
    [[nodiscard]] std::vector<const Route*> match(std::string_view path) const;

    [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

private:
    std::vector<Route> routes_;
};

/// The value of an Allow header for these routes, with the methods that come by themselves.
[[nodiscard]] std::string allowed_methods(const std::vector<const Route*>& routes);

}  // namespace vsplit::rest
