#include "rest/openapi.h"

#include <algorithm>

#include "rest/handlers.h"
#include "rest/json_schema.h"
#include "rest/message_shape.h"
#include "rest/openapi_headers.h"
#include "rest/pages.h"
#include "rest/problem.h"
#include "wire/error_table.h"

namespace vsplit::rest {
namespace pb = google::protobuf;
using Field = pb::FieldDescriptor;

namespace {

void append(Json& list, const Json& more) { list.insert(list.end(), more.begin(), more.end()); }

// An answer that says what was wrong.
Json problem(const char* description, std::initializer_list<const char*> headers) {
    return {{"description", description},
            {"headers", headers_of(headers)},
            {"content", {{std::string(kProblemType), {{"schema", {{"$ref", "#/components/schemas/Problem"}}}}}}}};
}

// Writes one operation of the document.
class Operation {
public:
    Operation(const Route& route, JsonSchemas& schemas) : route_(route), rpc_(*route.rpc), schemas_(schemas) {}

    [[nodiscard]] Json write() const {
        const std::string comment = comment_of(rpc_);
        Json operation{{"operationId", rpc_.name()}, {"summary", first_sentence(comment)}, {"description", comment}};
        operation["tags"] = {rpc_.service()->name()};
        operation["parameters"] = parameters();
        const Json body = request_body();
        if (!body.empty()) operation["requestBody"] = body;
        operation["responses"] = responses();
        return operation;
    }

private:
    [[nodiscard]] bool in_path(const std::string& field) const {
        const std::vector<std::string> fields = route_.path.fields();
        return std::find(fields.begin(), fields.end(), field) != fields.end();
    }

    [[nodiscard]] Json parameters() const {
        Json all = Json::array();
        const bool raw = shape_of(rpc_) == RpcShape::kUpload || takes_mesh_body(rpc_);
        for (int i = 0; i < rpc_.input_type()->field_count(); ++i) {
            const Field& field = *rpc_.input_type()->field(i);
            if (in_path(field.name())) {
                all.push_back(parameter(field, "path"));
            } else if ((route_.body.empty() || raw) && !is_of_chunk(field) && is_leaf(field)) {
                all.push_back(parameter(field, "query"));
            }
        }
        if (shape_of(rpc_) == RpcShape::kFile) append(all, file_parameters());
        append(all, common_parameters());
        return all;
    }

    [[nodiscard]] static bool is_leaf(const Field& field) {
        return field.cpp_type() != Field::CPPTYPE_MESSAGE && field.type() != Field::TYPE_BYTES;
    }

    // What the body itself says in an upload.
    [[nodiscard]] bool is_of_chunk(const Field& field) const {
        const std::optional<ChunkShape> chunk = ChunkShape::of(*rpc_.input_type());
        return chunk && (&field == chunk->data || &field == chunk->offset || &field == chunk->size);
    }

    [[nodiscard]] Json parameter(const Field& field, const char* place) const {
        Json schema = schemas_.field(field);
        Json made{{"name", field.json_name()}, {"in", place}};
        if (std::string_view(place) == "path") made["required"] = true;
        if (schema.contains("description")) {
            made["description"] = schema["description"];
            schema.erase("description");
        }
        made["schema"] = std::move(schema);
        return made;
    }

    [[nodiscard]] Json request_body() const {
        static const Json binary{{"schema", Json::object()}};
        if (shape_of(rpc_) == RpcShape::kUpload) {
            return {{"required", true},
                    {"description", "The file as it is, of any size."},
                    {"content", {{std::string(kBytesType), binary}}}};
        }
        if (route_.body.empty()) return {};
        const Json json{{"schema", body_schema()}};
        if (!takes_mesh_body(rpc_)) return {{"content", {{std::string(kJsonType), json}}}};
        return {{"description", "A mesh file as it is, of any size, or JSON, or nothing."},
                {"content", {{std::string(kBytesType), binary}, {std::string(kJsonType), json}}}};
    }

    [[nodiscard]] Json body_schema() const {
        if (route_.body == "*") return schemas_.reference(*rpc_.input_type());
        return schemas_.field(*rpc_.input_type()->FindFieldByName(route_.body));
    }

    [[nodiscard]] Json responses() const {
        Json all;
        all["200"] = success();
        if (shape_of(rpc_) == RpcShape::kFile) {
            all["206"] =
                file("The range of the file that Range asks for, where If-Range names the file or is absent.", {"ContentRange"});
            all["304"] = {{"description", "If-None-Match names the file: the client has it."}, {"headers", headers_of({"ETag"})}};
            all["412"] = problem("If-Match names other files only.", {});
            all["416"] = problem("The range begins behind the end of the file.", {"ContentRange"});
        }
        all["default"] = {{"$ref", "#/components/responses/Problem"}};
        return all;
    }

    [[nodiscard]] static Json file(const char* description, std::initializer_list<const char*> more = {}) {
        Json headers = headers_of({"ContentDisposition", "ETag", "AcceptRanges"});
        headers.update(headers_of(more));
        return {{"description", description}, {"headers", headers}, {"content", {{"*/*", Json::object()}}}};
    }

    [[nodiscard]] Json success() const {
        const pb::Descriptor& type = *rpc_.output_type();
        switch (shape_of(rpc_)) {
            case RpcShape::kFile:
                return file("The file, as its own type or, where Accept names that, as application/octet-stream.");
            case RpcShape::kEvents:
                return {
                    {"description",
                     "application/json: waits and gives what the last event holds. application/x-ndjson: an event a line, "
                     "without "
                     "those that carry bytes; the last line is the result or an error, which is a Problem. application/x-vsplit: "
                     "every event as protobuf, its length before it as a varint."},
                    {"headers", headers_of()},
                    {"content",
                     {{std::string(kJsonType), {{"schema", last_word(type)}}},
                      {"application/x-ndjson", {{"schema", schemas_.reference(type)}}},
                      {"application/x-vsplit", Json::object()}}}};
            case RpcShape::kUnary:
            case RpcShape::kUpload:
            case RpcShape::kNone:
                break;
        }
        return {{"description", first_sentence(comment_of(type)) + "."},
                {"headers", headers_of()},
                {"content", {{std::string(kJsonType), {{"schema", schemas_.reference(type)}}}}}};
    }

    // What a stream that succeeds ends with: the last kind of event that carries no bytes and is no error.
    [[nodiscard]] Json last_word(const pb::Descriptor& type) const {
        const pb::OneofDescriptor* const oneof = sole_oneof(type);
        for (int i = oneof == nullptr ? 0 : oneof->field_count(); i > 0; --i) {
            const pb::Descriptor* const kind = oneof->field(i - 1)->message_type();
            if (kind != nullptr && !has_bytes(*kind) && kind->full_name() != "google.rpc.Status")
                return schemas_.reference(*kind);
        }
        return schemas_.reference(type);
    }

    const Route& route_;
    const pb::MethodDescriptor& rpc_;
    JsonSchemas& schemas_;
};

Json problem_schema() {
    Json causes = Json::array();
    for (const wire::ErrorRow& row : wire::error_table()) causes.push_back(cause_name(row.cause));
    return {
        {"type", "object"},
        {"description", "RFC 9457: what went wrong, with the cause and words that gRPC tells too."},
        {"required", {"title", "status", "detail", "cause"}},
        {"properties",
         {{"title", {{"type", "string"}, {"description", "The HTTP status in words."}}},
          {"status", {{"type", "integer"}, {"description", "The HTTP status."}}},
          {"detail", {{"type", "string"}, {"description", "What was wrong, where, and what would be accepted."}}},
          {"cause", {{"type", "string"}, {"enum", causes}}},
          {"field", {{"type", "string"}, {"description", "The field of the request that is at fault, where one is."}}},
          {"retryAfter",
           {{"type", "integer"}, {"description", "Seconds after which the same request may succeed, where waiting helps."}}}}}};
}

enum class Secured { kYes, kNo };

Json page(const char* id, const char* summary, const char* type, Secured secured = Secured::kNo) {
    Json operation{{"operationId", id}, {"summary", summary}, {"tags", {"Operations"}}, {"parameters", common_parameters()}};
    if (secured == Secured::kNo) operation["security"] = Json::array();
    operation["responses"] = {
        {"200", {{"description", summary}, {"headers", headers_of()}, {"content", {{type, Json::object()}}}}},
        {"default", {{"$ref", "#/components/responses/Problem"}}}};
    return {{"get", operation}};
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; });
    return text;
}

}  // namespace

std::string openapi_document(const Schema& schema, const Router& router, std::string_view version) {
    JsonSchemas schemas;
    Json document{{"openapi", "3.1.0"}};
    document["info"] = {
        {"title", "vsplit"}, {"version", version}, {"license", {{"name", "Apache-2.0"}, {"identifier", "Apache-2.0"}}}};
    document["servers"] = {{{"url", "/"}}};
    // A server without tokens lets everybody in.
    document["security"] = {Json::object(), {{"bearer", Json::array()}}};
    document["tags"] = Json::array();
    for (const pb::ServiceDescriptor* service : schema.services()) {
        document["tags"].push_back({{"name", service->name()}, {"description", comment_of(*service)}});
    }
    document["tags"].push_back({{"name", "Operations"}, {"description", "For those who run the server."}});
    Json& paths = document["paths"] = Json::object();
    for (const Route& route : router.routes()) {
        paths[route.path.openapi_path()][lower(route.method)] = Operation(route, schemas).write();
    }
    paths["/"] = page("Page", "The page for people with a browser; where it was not built, a few words.", "text/html");
    paths["/healthz"] = page("Health", "The server is alive.", "application/json");
    paths[std::string(kReadyPath)] = page("Readiness", "The server takes new work; 503 while it shuts down.", "application/json");
    paths["/metrics"] = page("Metrics", "Metrics in Prometheus' text format.", "text/plain", Secured::kYes);
    paths["/openapi.json"] = page("OpenApi", "This document.", "application/json");
    Json& components = document["components"];
    components["schemas"] = schemas.all();
    components["schemas"]["Problem"] = problem_schema();
    components["parameters"] = header_parameters();
    components["headers"] = header_components();
    components["responses"]["Problem"] =
        problem("What was wrong; there are no other errors.", {"RetryAfter", "Allow", "Authenticate"});
    components["securitySchemes"]["bearer"] = {
        {"type", "http"},
        {"scheme", "bearer"},
        {"description",
         "A token of the server's --token-file. 401 without one, 403 where it may only read and the operation writes. A server "
         "without that file wants none."}};
    return document.dump(2) + '\n';
}

}  // namespace vsplit::rest
