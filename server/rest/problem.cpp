#include "rest/problem.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "rest/asio.h"
#include "wire/error_table.h"
#include "wire/utf8.h"

namespace vsplit::rest {
namespace {

std::string title_of(unsigned status) {
    if (status == 499) return "Client Closed Request";  // nginx's number; the others are registered
    return std::string(http::obsolete_reason(http::int_to_status(status)));
}

}  // namespace

Problem problem_of(const Error& error) { return {error, static_cast<unsigned>(wire::http_status(error))}; }

Problem problem_of(const grpc::Status& status) { return problem_of(wire::from_status(status)); }

Problem http_problem(unsigned status, Cause cause, std::string message, std::string field) {
    return {{cause, std::move(message), std::move(field)}, status};
}

std::string problem_json(const Problem& problem) {
    nlohmann::ordered_json json;
    json["title"] = title_of(problem.status);
    json["status"] = problem.status;
    json["detail"] = wire::valid_utf8(problem.error.message, wire::kMaxMessageBytes);
    json["cause"] = cause_name(problem.error.cause);
    if (!problem.error.field.empty()) json["field"] = wire::valid_utf8(problem.error.field, wire::kMaxMessageBytes);
    if (problem.error.retry_after > 0) json["retryAfter"] = problem.error.retry_after;
    return json.dump() + '\n';
}

}  // namespace vsplit::rest
