#include "rest/openapi_headers.h"

#include <array>
#include <string>

namespace vsplit::rest {
namespace {

// A field of a header, by the key of its component.
struct HeaderText {
    const char* key;
    const char* name;
    const char* description;
};

constexpr std::array kOfRequests{
    HeaderText{"RequestId", "X-Request-Id",
               "The client's own name for the request, by which the log and the answer name it: 1 to 64 letters, digits, '.', "
               "'_' and '-'."},
    HeaderText{"Traceparent", "traceparent",
               "Where the request stands in a trace, as W3C's Trace Context has it; the rpcs go on from there."},
    HeaderText{"Range", "Range",
               "bytes=FIRST-LAST, bytes=FIRST- or bytes=-COUNT of the file as it is; more than one range is answered whole."},
    HeaderText{"IfRange", "If-Range", "The ETag of the file that the range is of; of another file everything is sent."},
    HeaderText{"IfMatch", "If-Match", "ETags of which the file must have one, else 412."},
    HeaderText{"IfNoneMatch", "If-None-Match", "ETags that the client holds; where the file has one of them, 304."},
};

constexpr std::array kOfAnswers{
    HeaderText{"RequestId", "X-Request-Id", "By what the request is named in the log: what the client called it, or a new name."},
    HeaderText{"Traceparent", "traceparent", "The trace that the request belongs to, and its span."},
    HeaderText{"ContentDisposition", "Content-Disposition", "attachment, with a name for the file."},
    HeaderText{"ETag", "ETag", "By which the file is known: the same bytes have the same, whatever session they come from."},
    HeaderText{"AcceptRanges", "Accept-Ranges", "bytes."},
    HeaderText{"ContentRange", "Content-Range", "The part of the file that is sent, or its size where there is no such part."},
    HeaderText{"RetryAfter", "Retry-After", "Seconds after which the same request may succeed, where waiting helps."},
    HeaderText{"Allow", "Allow", "Of 405: the methods that the path has."},
    HeaderText{"Authenticate", "WWW-Authenticate", "Of 401: Bearer."},
};

Json text_schema() { return {{"type", "string"}}; }

Json reference(const char* kind, const char* key) { return {{"$ref", std::string("#/components/") + kind + '/' + key}}; }

Json parameters(std::initializer_list<const char*> keys) {
    Json all = Json::array();
    for (const char* key : keys) all.push_back(reference("parameters", key));
    return all;
}

const char* name_of(const std::string& key) {
    for (const HeaderText& header : kOfAnswers) {
        if (header.key == key) return header.name;
    }
    return "";
}

}  // namespace

Json header_parameters() {
    Json all;
    for (const HeaderText& header : kOfRequests) {
        all[header.key] = {
            {"name", header.name}, {"in", "header"}, {"description", header.description}, {"schema", text_schema()}};
    }
    return all;
}

Json header_components() {
    Json all;
    for (const HeaderText& header : kOfAnswers)
        all[header.key] = {{"description", header.description}, {"schema", text_schema()}};
    return all;
}

Json common_parameters() { return parameters({"RequestId", "Traceparent"}); }

Json file_parameters() { return parameters({"Range", "IfRange", "IfMatch", "IfNoneMatch"}); }

Json headers_of(std::initializer_list<const char*> keys) {
    Json all;
    for (const char* key : {"RequestId", "Traceparent"}) all[name_of(key)] = reference("headers", key);
    for (const char* key : keys) all[name_of(key)] = reference("headers", key);
    return all;
}

}  // namespace vsplit::rest
