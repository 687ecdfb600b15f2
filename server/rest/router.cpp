#include "rest/router.h"

#include <algorithm>
#include <utility>

#include "google/api/annotations.pb.h"

namespace vsplit::rest {
namespace pb = google::protobuf;

namespace {

struct Pattern {
    std::string method;
    std::string path;
};

Pattern pattern_of(const google::api::HttpRule& rule) {
    using Rule = google::api::HttpRule;
    switch (rule.pattern_case()) {
        case Rule::kGet:
            return {"GET", rule.get()};
        case Rule::kPut:
            return {"PUT", rule.put()};
        case Rule::kPost:
            return {"POST", rule.post()};
        case Rule::kDelete:
            return {"DELETE", rule.delete_()};
        case Rule::kPatch:
            return {"PATCH", rule.patch()};
        case Rule::kCustom:
            return {rule.custom().kind(), rule.custom().path()};
        case Rule::PATTERN_NOT_SET:
            break;
    }
    return {};
}

Error at_fault(const pb::MethodDescriptor& rpc, const std::string& why) {
    return {Cause::kMalformedInput, "google.api.http of " + rpc.full_name() + ": " + why, ""};
}

Expected<Route> route_of(const pb::MethodDescriptor& rpc, const google::api::HttpRule& rule) {
    const Pattern pattern = pattern_of(rule);
    Expected<PathTemplate> path = PathTemplate::parse(pattern.path);
    if (!path) return at_fault(rpc, path.error().message);
    if (!rule.body().empty() && rule.body() != "*" && rpc.input_type()->FindFieldByName(rule.body()) == nullptr) {
        return at_fault(rpc, "the request has no field " + rule.body());
    }
    return Route{pattern.method, *std::move(path), rule.body(), &rpc};
}

}  // namespace

Expected<Router> Router::make(const Schema& schema) {
    Router router;
    for (const pb::ServiceDescriptor* service : schema.services()) {
        for (int i = 0; i < service->method_count(); ++i) {
            const pb::MethodDescriptor& rpc = *service->method(i);
            if (!rpc.options().HasExtension(google::api::http)) continue;
            const google::api::HttpRule& rule = rpc.options().GetExtension(google::api::http);
            std::vector<const google::api::HttpRule*> rules{&rule};
            for (const google::api::HttpRule& more : rule.additional_bindings()) rules.push_back(&more);
            for (const google::api::HttpRule* each : rules) {
                Expected<Route> route = route_of(rpc, *each);
                if (!route) return route.error();
                router.routes_.push_back(*std::move(route));
            }
        }
    }
    return router;
}

std::vector<const Route*> Router::match(std::string_view path) const {
    std::vector<const Route*> best;
    for (const Route& route : routes_) {
        if (!route.path.match(path)) continue;
        const std::size_t told = route.path.specificity();
        if (!best.empty() && told < best.front()->path.specificity()) continue;
        if (!best.empty() && told > best.front()->path.specificity()) best.clear();
        best.push_back(&route);
    }
    return best;
}

std::string allowed_methods(const std::vector<const Route*>& routes) {
    std::vector<std::string> methods;
    for (const Route* route : routes) {
        methods.push_back(route->method);
        if (route->method == "GET") methods.emplace_back("HEAD");
    }
    methods.emplace_back("OPTIONS");
    std::sort(methods.begin(), methods.end());
    methods.erase(std::unique(methods.begin(), methods.end()), methods.end());
    std::string text;
    for (const std::string& method : methods) text += (text.empty() ? "" : ", ") + method;
    return text;
}

}  // namespace vsplit::rest
