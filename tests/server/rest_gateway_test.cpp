// The REST door: every rpc over HTTP, and what HTTP itself asks of a server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "rest_client.h"
#include "test_client.h"
#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"

namespace vsplit::test {
namespace {

using ::testing::HasSubstr;

const Fields kJson{{"Content-Type", "application/json"}};

::testing::AssertionResult is_problem(const HttpReply& reply, unsigned status, const std::string& cause) {
    if (reply.status != status || !reply.whole || reply.fields.count("Content-Type") == 0 ||
        reply.fields.at("Content-Type") != "application/problem+json" ||
        json_at(reply.body, "/status") != std::to_string(status) || json_at(reply.body, "/cause") != cause ||
        json_at(reply.body, "/detail").empty() || json_at(reply.body, "/title").empty()) {
        return ::testing::AssertionFailure() << reply.status << ' ' << reply.body;
    }
    return ::testing::AssertionSuccess();
}

std::string chunked(const std::string& body, std::size_t part) {
    std::string text;
    for (std::size_t at = 0; at < body.size(); at += part) {
        const std::string data = body.substr(at, part);
        char size[20];  // NOLINT(modernize-avoid-c-arrays)
        std::snprintf(size, sizeof size, "%zx\r\n", data.size());
        text += size + data + "\r\n";
    }
    return text + "0\r\n\r\n";
}

class RestTest : public ::testing::Test {
protected:
    HttpReply ask(const std::string& method, const std::string& target, const Fields& fields = {}, const std::string& body = "") {
        return test::ask(server_.port(), method, target, fields, body);
    }

    // The id of a session with this mesh.
    std::string session_of(const TriangleMesh& mesh) {
        const HttpReply created = ask("POST", "/v1/sessions", {{"Content-Type", "application/octet-stream"}}, file_of(mesh));
        EXPECT_EQ(created.status, 200U) << created.body;
        return json_at(created.body, "/id");
    }

    RestFixture server_;
};

TEST_F(RestTest, CreatesReadsListsAndDeletesSessions) {
    const HttpReply created = ask("POST", "/v1/sessions");
    ASSERT_EQ(created.status, 200U) << created.body;
    const std::string id = json_at(created.body, "/id");
    EXPECT_EQ(json_at(ask("GET", "/v1/sessions/" + id).body, "/id"), id);
    EXPECT_EQ(json_at(ask("GET", "/v1/sessions?pageSize=5").body, "/sessions/0/id"), id);
    EXPECT_EQ(ask("DELETE", "/v1/sessions/" + id).status, 200U);
    EXPECT_TRUE(is_problem(ask("GET", "/v1/sessions/" + id), 404, "NOT_FOUND"));
}

TEST_F(RestTest, CreatesWithAMeshInTheBodyOrNotAtAll) {
    const std::string id = session_of(icosphere(2));
    EXPECT_EQ(json_at(ask("GET", "/v1/sessions/" + id).body, "/source/faces"), "320");
    const HttpReply text = ask("POST", "/v1/sessions?format=stl-ascii&weld=1e-6", {}, write_mesh(cube(), MeshFormat::kStlAscii));
    EXPECT_EQ(json_at(text.body, "/source/faces"), "12");
    EXPECT_TRUE(is_problem(ask("POST", "/v1/sessions", {}, "no mesh"), 415, "UNKNOWN_FORMAT"));
    EXPECT_TRUE(is_problem(ask("POST", "/v1/sessions?format=tiff", {}, "x"), 400, "INVALID_OPTION"));
    EXPECT_EQ(server_.grpc().service().load().sessions, 2U) << "what failed left none behind";
}

TEST_F(RestTest, UnitsAndFormatsGoByTheirSymbolsToo) {
    const HttpReply created = ask("POST", "/v1/sessions?unit=in&repair=Safe", {}, file_of(cube()));
    ASSERT_EQ(created.status, 200U) << created.body;
    EXPECT_EQ(json_at(created.body, "/source/unit"), "INCH");
    const std::string mesh = "/v1/sessions/" + json_at(created.body, "/id") + "/mesh";
    const HttpReply file = ask("GET", mesh + "?unit=mm&format=3mf");
    EXPECT_EQ(file.status, 200U) << file.body;
    EXPECT_EQ(file.body, ask("GET", mesh + "?unit=MILLIMETRE&format=three-mf").body);
    EXPECT_TRUE(is_problem(ask("GET", mesh + "?unit=yd"), 400, "INVALID_OPTION"));
    const HttpReply json =
        ask("POST", "/v1/sessions", {{"Content-Type", "application/json"}}, R"({"unit": "mm", "repair": "full"})");
    EXPECT_EQ(json.status, 200U) << json.body;
}

TEST_F(RestTest, ACreateWhoseClientLeavesLeavesNothing) {
    const auto cancelled = [&] {
        const std::vector<std::string> rpcs = server_.grpc().finished();
        return std::count(rpcs.begin(), rpcs.end(), "UploadMesh CANCELLED");
    };
    for (const char* rest : {"Content-Length: 100000\r\n\r\nabc", "Transfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n"}) {
        const auto before = cancelled();
        HttpClient client(server_.port());
        client.send(std::string("POST /v1/sessions HTTP/1.1\r\nHost: t\r\nContent-Type: model/stl\r\n") + rest);
        ASSERT_TRUE(eventually([&] { return server_.grpc().service().load().sessions == 1; }));
        client.close();
        EXPECT_TRUE(eventually([&] { return server_.grpc().service().load().sessions == 0; })) << rest;
        EXPECT_TRUE(eventually([&] { return cancelled() > before; }));
    }
}

// The rate lets the session and its upload in, and no third rpc for a while.
TEST(RestRateTest, ACreateThatFailsLeavesNothingWhateverTheRate) {
    guard::Gatekeeper gate(nullptr, 1);
    rpc::GrpcExtras extras;
    extras.gate = &gate;
    RestFixture server(small_server(), {}, extras);
    EXPECT_TRUE(is_problem(ask(server.port(), "POST", "/v1/sessions", {}, "no mesh"), 415, "UNKNOWN_FORMAT"));
    EXPECT_TRUE(eventually([&] { return server.grpc().service().load().sessions == 0; }));
}

TEST_F(RestTest, UploadsWithALengthAndInChunks) {
    const std::string id = session_of(cube());
    const std::string file = file_of(icosphere(3));
    EXPECT_EQ(json_at(ask("PUT", "/v1/sessions/" + id + "/mesh", {}, file).body, "/source/faces"), "1280");
    HttpClient client(server_.port());
    client.send("PUT /v1/sessions/" + id + "/mesh HTTP/1.1\r\nHost: t\r\nTransfer-Encoding: chunked\r\n\r\n" +
                chunked(file_of(icosphere(1)), 777));
    EXPECT_EQ(json_at(client.read_reply().body, "/source/faces"), "80");
    EXPECT_EQ(client.ask("GET", "/healthz").status, 200U) << "the connection goes on";
}

TEST_F(RestTest, AFileWithoutBytesIsNoMesh) {
    EXPECT_TRUE(is_problem(ask("POST", "/v1/sessions", {{"Content-Type", "application/octet-stream"}}), 400, "EMPTY_INPUT"));
    EXPECT_EQ(server_.grpc().service().load().sessions, 0U);
}

// Else what follows could be a request of its own for one reader and a body for another.
TEST_F(RestTest, OnlyChunkedIsATransferCoding) {
    for (const std::string coding : {"gzip", "chunked, gzip", "gzip, chunked", "identity", "xchunked"}) {
        HttpClient client(server_.port());
        client.send("POST /v1/sessions HTTP/1.1\r\nHost: t\r\nTransfer-Encoding: " + coding +
                    "\r\n\r\nGET /healthz HTTP/1.1\r\nHost: t\r\n\r\n");
        const HttpReply reply = client.read_reply();
        EXPECT_TRUE(reply.status == 400 || reply.status == 501) << coding << ": " << reply.status;
        EXPECT_EQ(client.read_line(), "") << coding << ": a second answer";
    }
    HttpClient old(server_.port());  // whose proxies know no chunks
    old.send("POST /v1/sessions HTTP/1.0\r\nConnection: keep-alive\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n");
    EXPECT_EQ(old.read_reply().status, 501U);
    EXPECT_EQ(server_.grpc().service().load().sessions, 0U);
}

TEST_F(RestTest, AnUploadThatIsCutOffChangesNothing) {
    const std::string id = session_of(cube());
    HttpClient client(server_.port());
    client.send("PUT /v1/sessions/" + id + "/mesh HTTP/1.1\r\nHost: t\r\nContent-Length: 100000\r\n\r\nabc");
    client.close();
    EXPECT_TRUE(eventually([&] {
        for (const std::string& rpc : server_.grpc().finished()) {
            if (rpc == "UploadMesh CANCELLED") return true;
        }
        return false;
    }));
    EXPECT_EQ(json_at(ask("GET", "/v1/sessions/" + id).body, "/source/faces"), "12");
}

TEST_F(RestTest, TellsToGoOnOnlyWhenTheUploadIsAccepted) {
    const std::string id = session_of(cube());
    const std::string file = file_of(icosphere(1));
    const std::string rest =
        " HTTP/1.1\r\nHost: t\r\nExpect: 100-continue\r\nContent-Length: " + std::to_string(file.size()) + "\r\n\r\n";
    HttpClient client(server_.port());
    client.send("PUT /v1/sessions/" + id + "/mesh" + rest);
    EXPECT_EQ(client.read_line(), "HTTP/1.1 100 Continue\r");
    EXPECT_EQ(client.read_line(), "\r");
    client.send(file);
    EXPECT_EQ(json_at(client.read_reply().body, "/source/faces"), "80");
    // On a busy machine the news may come too late once, and the body is asked for in vain.
    EXPECT_TRUE(eventually([&] {
        HttpClient refused(server_.port());
        refused.send("PUT /v1/sessions/nobody/mesh" + rest);
        return refused.read_line() == "HTTP/1.1 404 Not Found\r";
    })) << "before the body was sent";
}

TEST_F(RestTest, DownloadsFilesAndRangesOfThem) {
    const TriangleMesh mesh = icosphere(4);
    const std::string target = "/v1/sessions/" + session_of(mesh) + "/mesh?format=ply";
    const HttpReply whole = ask("GET", target);
    EXPECT_EQ(whole.body, file_of(mesh));
    EXPECT_EQ(whole.fields.at("Content-Disposition"), "attachment; filename=\"mesh-5120.ply\"");
    EXPECT_EQ(whole.fields.at("Content-Length"), std::to_string(whole.body.size()));
    const HttpReply part = ask("GET", target, {{"Range", "bytes=1000-70000"}});
    EXPECT_EQ(part.status, 206U);
    EXPECT_EQ(part.body, whole.body.substr(1000, 69001));
    EXPECT_EQ(part.fields.at("Content-Range"), "bytes 1000-70000/" + std::to_string(whole.body.size()));
    EXPECT_EQ(ask("GET", target, {{"Range", "bytes=-10"}}).body, whole.body.substr(whole.body.size() - 10));
    const HttpReply behind = ask("GET", target, {{"Range", "bytes=99999999-"}});
    EXPECT_TRUE(is_problem(behind, 416, "INVALID_OPTION"));
    EXPECT_EQ(behind.fields.at("Content-Range"), "bytes */" + std::to_string(whole.body.size()));
    const HttpReply head = ask("HEAD", target);
    EXPECT_EQ(head.fields.at("Content-Length"), std::to_string(whole.body.size()));
    const HttpReply packed = ask("GET", target, {{"Accept-Encoding", "gzip"}});
    EXPECT_EQ(packed.fields.at("Content-Encoding"), "gzip");
    EXPECT_LT(packed.body.size(), whole.body.size());
}

TEST_F(RestTest, ADownloadIsKnownByItsBytes) {
    const std::string id = session_of(icosphere(3));
    const std::string target = "/v1/sessions/" + id + "/mesh?format=ply";
    const HttpReply whole = ask("GET", target);
    const std::string tag = whole.fields.at("ETag");
    EXPECT_THAT(tag, ::testing::MatchesRegex("\"[0-9a-f]{64}\"")) << "and by nothing that tells the session";
    EXPECT_EQ(whole.fields.at("Cache-Control"), "private, no-cache");
    EXPECT_EQ(ask("HEAD", target).fields.at("ETag"), tag);
    EXPECT_EQ(ask("GET", "/v1/sessions/" + session_of(icosphere(3)) + "/mesh?format=ply").fields.at("ETag"), tag);
    EXPECT_NE(ask("GET", "/v1/sessions/" + id + "/mesh?format=stl").fields.at("ETag"), tag);
    const std::string packed = ask("GET", target, {{"Accept-Encoding", "gzip"}}).fields.at("ETag");
    EXPECT_NE(packed, tag) << "other bytes";
    const HttpReply held = ask("GET", target, {{"If-None-Match", "\"other\""}, {"If-None-Match", "W/" + tag}});
    EXPECT_EQ(held.status, 304U);
    EXPECT_TRUE(held.whole && held.body.empty());
    EXPECT_EQ(held.fields.at("ETag"), tag);
    EXPECT_EQ(held.fields.count("Content-Length") + held.fields.count("Content-Type"), 0U);
    EXPECT_EQ(ask("HEAD", target, {{"If-None-Match", tag}}).status, 304U);
    EXPECT_EQ(ask("GET", target, {{"If-None-Match", packed}}).status, 200U);
    EXPECT_EQ(ask("GET", target, {{"If-None-Match", packed}, {"Accept-Encoding", "gzip"}}).status, 304U);
    EXPECT_TRUE(is_problem(ask("GET", target, {{"If-Match", "\"other\""}}), 412, "INVALID_OPTION"));
    EXPECT_EQ(ask("GET", target, {{"If-Match", tag}}).body, whole.body);
    ASSERT_EQ(ask("PUT", "/v1/sessions/" + id + "/mesh", {}, file_of(cube())).status, 200U);
    EXPECT_EQ(ask("GET", target, {{"If-None-Match", tag}}).status, 200U) << "the mesh is another one";
}

TEST_F(RestTest, RangesAreGetsAndOfTheFileThatIsMeant) {
    const std::string target = "/v1/sessions/" + session_of(icosphere(4)) + "/mesh?format=ply";
    const HttpReply whole = ask("GET", target);
    const std::string tag = whole.fields.at("ETag");
    const HttpReply part = ask("GET", target, {{"Range", "Bytes=10-19"}, {"If-Range", tag}, {"Accept-Encoding", "gzip"}});
    EXPECT_EQ(part.status, 206U);
    EXPECT_EQ(part.body, whole.body.substr(10, 10));
    EXPECT_EQ(part.fields.at("ETag"), tag);
    for (const std::string& other : {std::string("\"other\""), "W/" + tag, std::string("Sat, 29 Oct 1994 19:43:31 GMT")}) {
        EXPECT_EQ(ask("GET", target, {{"Range", "bytes=10-19"}, {"If-Range", other}}).status, 200U) << other;
    }
    EXPECT_EQ(ask("GET", target, {{"Range", "bytes=10-19"}, {"If-None-Match", tag}}).status, 304U);
    const HttpReply all = ask("GET", target, {{"Range", "bytes=0-99999999999999999999"}});
    EXPECT_EQ(all.status, 206U);
    EXPECT_EQ(all.body, whole.body);
    for (const char* range : {"bytes=10-19", "bytes=99999999-"}) {
        const HttpReply head = ask("HEAD", target, {{"Range", range}});
        EXPECT_EQ(head.status, 200U) << range;
        EXPECT_EQ(head.fields.count("Content-Range"), 0U);
        EXPECT_EQ(head.fields.at("Content-Length"), std::to_string(whole.body.size()));
    }
}

TEST_F(RestTest, WhatNeedsNoBytesHasNoFileWritten) {
    const std::string id = session_of(icosphere(4));
    const std::string target = "/v1/sessions/" + id + "/mesh?format=ply";
    const std::string other = "/v1/sessions/" + id + "/mesh?format=obj";
    const HttpReply whole = ask("GET", target);
    const std::string tag = whole.fields.at("ETag");
    const BlockedErrands blocked(server_.grpc().service());
    EXPECT_EQ(ask("GET", target, {{"If-None-Match", tag}}).status, 304U);
    EXPECT_TRUE(is_problem(ask("GET", target, {{"If-Match", "\"other\""}}), 412, "INVALID_OPTION"));
    EXPECT_TRUE(is_problem(ask("GET", target, {{"Range", "bytes=99999999-"}}), 416, "INVALID_OPTION"));
    const HttpReply head = ask("HEAD", target);
    EXPECT_EQ(head.status, 200U);
    EXPECT_EQ(head.fields.at("ETag"), tag);
    EXPECT_EQ(head.fields.at("Content-Length"), std::to_string(whole.body.size()));
    EXPECT_EQ(head.fields.at("Content-Disposition"), whole.fields.at("Content-Disposition"));
    const HttpReply unmade = ask("HEAD", other);
    EXPECT_EQ(unmade.status, 200U);
    EXPECT_EQ(unmade.fields.at("Content-Type"), "model/obj");
    EXPECT_EQ(unmade.fields.count("Content-Length") + unmade.fields.count("ETag"), 0U) << "only the making tells";
    EXPECT_EQ(ask("HEAD", "/v1/sessions/nobody/mesh").status, 404U);
    EXPECT_TRUE(is_problem(ask("GET", other, {{"Accept", "text/html"}, {"Range", "bytes=0-9"}}), 406, "UNSUPPORTED"));
    // What was written a moment ago is still there.
    EXPECT_EQ(ask("GET", target, {{"Range", "bytes=10-19"}}).body, whole.body.substr(10, 10));
    EXPECT_EQ(ask("GET", target).body, whole.body);
}

TEST_F(RestTest, ADownloadIsOfATypeThatTheClientTakes) {
    const std::string target = "/v1/sessions/" + session_of(cube()) + "/mesh";
    const auto type_for = [&](const Fields& fields, const std::string& query = "") {
        const HttpReply reply = ask("GET", target + query, fields);
        return reply.status == 200 ? reply.fields.at("Content-Type") : std::to_string(reply.status);
    };
    EXPECT_EQ(type_for({}), "model/stl");
    EXPECT_EQ(type_for({{"Accept", "*/*"}}), "model/stl");
    EXPECT_EQ(type_for({{"Accept", "model/*"}}), "model/stl");
    EXPECT_EQ(type_for({{"Accept", "application/octet-stream"}}), "application/octet-stream") << "what every file is";
    EXPECT_EQ(type_for({{"Accept", "text/html"}, {"Accept", "text/plain;q=0.1"}}, "?format=off"), "text/plain");
    const HttpReply refused = ask("GET", target, {{"Accept", "text/html"}});
    EXPECT_TRUE(is_problem(refused, 406, "UNSUPPORTED"));
    EXPECT_THAT(json_at(refused.body, "/detail"), HasSubstr("model/stl and application/octet-stream"));
    EXPECT_EQ(json_at(refused.body, "/field"), "Accept");
    EXPECT_EQ(type_for({{"Accept", "model/obj"}}), "406");
    EXPECT_EQ(ask("HEAD", target, {{"Accept", "text/html"}}).status, 406U);
}

TEST_F(RestTest, PagesThatDoNotChangeAreNotSentTwice) {
    const HttpReply first = ask("GET", "/openapi.json");
    EXPECT_EQ(first.fields.at("Cache-Control"), "no-cache");
    const HttpReply again = ask("GET", "/openapi.json", {{"If-None-Match", first.fields.at("ETag")}});
    EXPECT_EQ(again.status, 304U);
    EXPECT_TRUE(again.body.empty());
    EXPECT_EQ(again.fields.at("Cache-Control"), "no-cache");
    EXPECT_EQ(ask("GET", "/metrics").fields.count("ETag"), 0U);
    EXPECT_EQ(ask("GET", "/metrics").fields.at("Cache-Control"), "no-store");
}

TEST_F(RestTest, MethodsAnswerAsAcceptAsks) {
    const std::string id = session_of(icosphere(3));
    const std::string target = "/v1/sessions/" + id + ":improve";
    const std::string body = R"({"options": {"faces": 600, "tolerance": 0.05}})";
    const HttpReply json = ask("POST", target, kJson, body);
    ASSERT_EQ(json.status, 200U) << json.body;
    EXPECT_EQ(json_at(json.body, "/id"), "r1");
    EXPECT_EQ(json_at(json.body, "/improveOptions/faces"), "600");
    const HttpReply lines = ask("POST", target, {{"Content-Type", "application/json"}, {"Accept", "application/x-ndjson"}}, body);
    EXPECT_THAT(lines.body, ::testing::StartsWith(R"({"progress":{"stage":"queued")"));
    const std::string last = lines.body.substr(lines.body.rfind('\n', lines.body.size() - 2) + 1);
    EXPECT_EQ(json_at(last, "/representation/id"), "r1") << "the same request";
    EXPECT_THAT(lines.body, ::testing::Not(HasSubstr("payload")));
}

TEST_F(RestTest, BinaryEventsAreThoseOfGrpc) {
    const std::string id = session_of(icosphere(3));
    ASSERT_EQ(ask("POST", "/v1/sessions/" + id + ":improve", kJson, R"({"options": {"faces": 600, "tolerance": 0.05}})").status,
              200U);
    const HttpReply reply = ask("POST", "/v1/sessions/" + id + ":setResolution",
                                {{"Content-Type", "application/json"}, {"Accept", "application/x-vsplit"}}, R"({"faces": 500})");
    ASSERT_EQ(reply.status, 200U);
    v1::SetResolutionRequest request;
    request.set_session(id);
    request.set_faces(500);
    const auto context = call();
    const auto reader = server_.grpc().stub().SetResolution(context.get(), request);
    std::string expected;
    v1::ProgressiveEvent event;
    while (reader->Read(&event)) {
        std::string bytes = event.SerializeAsString();
        std::size_t length = bytes.size();
        for (; length > 127; length >>= 7U) expected += static_cast<char>(length | 128U);
        expected += static_cast<char>(length);
        expected += bytes;
    }
    EXPECT_TRUE(reader->Finish().ok());
    EXPECT_EQ(reply.body, expected);
}

TEST_F(RestTest, AClientThatLeavesCancelsItsMethod) {
    const std::string id = session_of(icosphere(3));
    for (const char* accept : {"application/json", "application/x-ndjson"}) {
        const std::size_t before = server_.grpc().finished().size();
        HttpClient client(server_.port());
        const std::string body = R"({"options": {"subdivisionSize": 0.006}})";
        client.begin("POST", "/v1/sessions/" + id + ":improve", {{"Accept", accept}}, body);
        ASSERT_TRUE(eventually([&] { return server_.grpc().service().load().methods_running == 1; }));
        client.close();
        EXPECT_TRUE(eventually([&] { return server_.grpc().finished().size() > before; }));
        EXPECT_EQ(server_.grpc().finished().back(), "Improve CANCELLED");
    }
}

TEST_F(RestTest, ErrorsOfAStreamAreItsLastWord) {
    const std::string id = session_of(icosphere(3));
    const std::string body = R"({"options": {"subdivisionSize": 0.006}})";
    const auto begin = [&](HttpClient& client, const std::string& accept) {
        client.begin("POST", "/v1/sessions/" + id + ":improve", {{"Accept", accept}}, body);
    };
    HttpClient lines(server_.port());
    begin(lines, "application/x-ndjson");
    ASSERT_TRUE(eventually([&] { return server_.grpc().service().load().methods_running == 1; }));
    HttpClient frames(server_.port());
    begin(frames, "application/x-vsplit");
    ASSERT_TRUE(eventually([&] { return server_.grpc().service().load().methods_waiting == 1; }));
    EXPECT_EQ(ask("DELETE", "/v1/sessions/" + id).status, 200U);
    const HttpReply told = lines.read_reply();
    EXPECT_TRUE(told.whole);
    EXPECT_THAT(told.body, HasSubstr(R"({"error":{"title":)"));
    const HttpReply framed = frames.read_reply();
    EXPECT_TRUE(framed.whole);
    v1::ProgressiveEvent last;
    const std::size_t first = static_cast<unsigned char>(framed.body[0]);  // "queued", short
    std::size_t at = first + 1;
    std::size_t length = static_cast<unsigned char>(framed.body[at++]);
    if (length > 127) length = (length & 127U) | static_cast<std::size_t>(framed.body[at++]) << 7U;
    ASSERT_TRUE(last.ParseFromString(framed.body.substr(at, length)));
    EXPECT_EQ(last.error().details_size(), 1);
    EXPECT_THAT(last.error().message(), HasSubstr("deleted"));
}

TEST_F(RestTest, ProblemsHaveTheWordsOfGrpc) {
    const std::string id = session_of(cube());
    v1::ImproveRequest request;
    request.set_session(id);
    request.mutable_options()->set_tolerance(-1);
    const Received refused = improve(server_.grpc().stub(), request);
    const HttpReply reply = ask("POST", "/v1/sessions/" + id + ":improve?options.tolerance=-1");
    EXPECT_TRUE(is_problem(reply, 400, "INVALID_OPTION"));
    EXPECT_EQ(json_at(reply.body, "/detail"), refused.status.error_message());
    EXPECT_EQ(json_at(reply.body, "/field"), "tolerance");
}

TEST_F(RestTest, RefusesWhatHttpHasANameFor) {
    const std::string id = session_of(cube());
    const std::string session = "/v1/sessions/" + id;
    EXPECT_TRUE(is_problem(ask("GET", "/v1/other"), 404, "NOT_FOUND"));
    const HttpReply method = ask("PATCH", session);
    EXPECT_TRUE(is_problem(method, 405, "UNSUPPORTED"));
    EXPECT_EQ(method.fields.at("Allow"), "DELETE, GET, HEAD, OPTIONS");
    EXPECT_EQ(ask("OPTIONS", session + ":improve").fields.at("Allow"), "OPTIONS, POST");
    EXPECT_THAT(ask("POST", "/v1/sessions/:improve").body, HasSubstr("a name in the path is empty"));
    EXPECT_TRUE(is_problem(ask("GET", session, {{"Accept", "text/html"}}), 406, "UNSUPPORTED"));
    EXPECT_TRUE(
        is_problem(ask("POST", session + ":improve", {{"Accept", "text/html, application/json;q=0"}}), 406, "UNSUPPORTED"));
    EXPECT_TRUE(is_problem(ask("POST", session + ":improve", {{"Content-Type", "text/plain"}}, "{}"), 415, "UNSUPPORTED"));
    EXPECT_TRUE(is_problem(ask("PUT", session + "/mesh", kJson, "{}"), 415, "UNSUPPORTED"));
    const Fields packed{{"Content-Type", "application/json"}, {"Content-Encoding", "gzip"}};
    EXPECT_TRUE(is_problem(ask("POST", session + ":improve", packed, "{}"), 415, "UNSUPPORTED"));
    EXPECT_TRUE(is_problem(ask("POST", session + ":improve", kJson, "{\"optoins\": {}}"), 400, "INVALID_OPTION"));
    EXPECT_TRUE(is_problem(ask("GET", session + "/quality?worst=many"), 400, "INVALID_OPTION"));
    EXPECT_TRUE(is_problem(ask("GET", session + "?x=%zz"), 400, "MALFORMED_INPUT"));
    EXPECT_TRUE(is_problem(ask("GET", session, kJson, "{}"), 400, "MALFORMED_INPUT"));
    EXPECT_TRUE(is_problem(ask("BREW", session), 501, "UNSUPPORTED"));
    EXPECT_TRUE(is_problem(ask("GET", "/healthz", {{"X", std::string(20000, 'x')}}), 431, "LIMIT_EXCEEDED"));
    EXPECT_TRUE(is_problem(ask("GET", "/healthz", {{"Host", "two"}}), 400, "MALFORMED_INPUT"));
    for (const char* token : {"Bearer \xff", "Bearer a\tb"}) {  // what gRPC would end the program for
        EXPECT_TRUE(is_problem(ask("GET", session, {{"Authorization", token}}), 400, "MALFORMED_INPUT"));
    }
}

TEST_F(RestTest, AFieldThatDoesNotTakeItsValueIsNamed) {
    const std::string target = "/v1/sessions/" + session_of(cube()) + ":improve";
    for (const std::string value : {"1.5", "-5", "1e30", "\"abc\""}) {
        const std::string plain = value == "\"abc\"" ? "abc" : value;
        const std::string body = std::string(R"({"options": {"faces": )").append(value).append("}}");
        const std::string query = std::string("?options.faces=").append(plain);
        for (const HttpReply& reply : {ask("POST", target, kJson, body), ask("POST", target + query)}) {
            EXPECT_TRUE(is_problem(reply, 400, "INVALID_OPTION"));
            EXPECT_EQ(json_at(reply.body, "/field"), "options.faces");
            EXPECT_THAT(json_at(reply.body, "/detail"), HasSubstr("a whole number from 0 to 4294967295"));
        }
    }
}

TEST_F(RestTest, WhatARequestSaysOfAFieldMustAgree) {
    const std::string id = session_of(cube());
    const std::string session = "/v1/sessions/" + id;
    const auto refused = [&](const HttpReply& reply, const std::string& field) {
        EXPECT_TRUE(is_problem(reply, 400, "INVALID_OPTION"));
        EXPECT_EQ(json_at(reply.body, "/field"), field);
    };
    refused(ask("GET", session + "?session=other"), "session");
    refused(ask("GET", session + "/quality?session=other"), "session");
    refused(ask("PUT", session + "/mesh?session=other", {}, file_of(cube())), "session");
    refused(ask("POST", "/v1/sessions?session=other", {}, file_of(cube())), "session");
    refused(ask("POST", session + ":improve", kJson, R"({"session": "other"})"), "session");
    refused(ask("POST", session + ":improve?options.faces=8", kJson, R"({"options": {"faces": 9}})"), "options.faces");
    refused(ask("GET", session + "/quality?worst=1&worst=2"), "worst");
    EXPECT_EQ(ask("GET", session + "?session=" + id).status, 200U);
    EXPECT_EQ(ask("POST", session + ":keepAlive", kJson, R"({"session": ")" + id + "\"}").status, 200U);
    EXPECT_EQ(ask("GET", session + "/quality?worst=1&worst=1").status, 200U);
}

TEST_F(RestTest, AResolutionIsARepresentations) {
    const std::string id = session_of(icosphere(3));
    for (const char* target : {"/quality?faces=500", "/mesh?faces=500"}) {
        const HttpReply reply = ask("GET", "/v1/sessions/" + id + target);
        EXPECT_TRUE(is_problem(reply, 400, "INVALID_OPTION")) << target;
        EXPECT_EQ(json_at(reply.body, "/field"), "faces");
        EXPECT_THAT(json_at(reply.body, "/detail"), HasSubstr("together with the id of a representation"));
    }
    EXPECT_TRUE(failed_with(get_quality(server_.grpc().stub(), id, "", 500).status, Cause::kInvalidOption, "faces"));
    EXPECT_TRUE(failed_with(download(server_.grpc().stub(), id, "", 500).status, Cause::kInvalidOption, "faces"));
    v1::ImproveRequest request = small_improve(id);
    request.mutable_source()->set_faces(500);
    EXPECT_TRUE(failed_with(improve(server_.grpc().stub(), request).status, Cause::kInvalidOption, "faces"));
}

TEST_F(RestTest, JsonThatWouldTakeMuchMemoryIsRefusedBeforeItDoes) {
    const std::string target = "/v1/sessions/" + session_of(cube()) + ":improve";
    const auto list_of = [](const std::string& element, std::size_t count) {
        std::string text = element;
        for (std::size_t i = 1; i < count; ++i) text += ',' + element;
        return text;
    };
    const std::string boxes = R"({"options": {"sizing": {"boxes": [)" + list_of("{}", 500'000) + "]}}}";
    const HttpReply reply = ask("POST", target, kJson, boxes);
    EXPECT_TRUE(is_problem(reply, 413, "LIMIT_EXCEEDED"));
    EXPECT_THAT(json_at(reply.body, "/detail"), HasSubstr("500003 objects"));
    EXPECT_THAT(json_at(reply.body, "/detail"), HasSubstr("limit json_memory is 134217728"));
    const std::string ids = R"({"options": {"regions": [)" + list_of("0", 5'000'000) + "]}}";
    EXPECT_TRUE(is_problem(ask("POST", target, kJson, ids), 413, "LIMIT_EXCEEDED"));
    const std::string few = R"({"options": {"sizing": {"boxes": [)" + list_of("{}", 2'000) + "]}}}";
    EXPECT_TRUE(is_problem(ask("POST", target, kJson, few), 400, "INVALID_OPTION")) << "the method's own limit";
}

TEST_F(RestTest, DeepAndHugeJsonIsRefused) {
    const std::string target = "/v1/sessions/" + session_of(cube()) + ":improve";
    EXPECT_TRUE(is_problem(ask("POST", target, kJson, std::string(100'000, '[')), 400, "MALFORMED_INPUT"));
    std::string deep;
    for (int i = 0; i < 20'000; ++i) deep += "{\"options\":";
    EXPECT_TRUE(is_problem(ask("POST", target, kJson, deep), 400, "INVALID_OPTION"));
    HttpClient client(server_.port());
    client.send("POST " + target +
                " HTTP/1.1\r\nHost: t\r\nContent-Type: application/json\r\nContent-Length: 99999999999\r\n\r\n");
    EXPECT_TRUE(is_problem(client.read_reply(), 413, "LIMIT_EXCEEDED"));
}

TEST_F(RestTest, AnswersPipelinedRequestsInOrder) {
    HttpClient client(server_.port());
    const std::string host = " HTTP/1.1\r\nHost: t\r\n\r\n";
    client.send("GET /healthz" + host + "GET /nowhere" + host + "GET /readyz" + host);
    EXPECT_EQ(client.read_reply().status, 200U);
    EXPECT_EQ(client.read_reply().status, 404U);
    EXPECT_EQ(client.read_reply().status, 200U);
}

TEST_F(RestTest, PagesOfOtherOriginsAreRefusedUntilTheyAreAllowed) {
    EXPECT_TRUE(is_problem(ask("GET", "/v1/sessions", {{"Origin", "https://elsewhere.example"}}), 403, "INVALID_OPTION"));
    EXPECT_EQ(ask("GET", "/v1/sessions", {{"Origin", "http://test"}}).status, 200U) << "the server's own pages";
    rest::RestOptions options;
    options.cors_origins = {"https://elsewhere.example"};
    RestFixture open(small_server(), options);
    const HttpReply read = test::ask(open.port(), "GET", "/v1/sessions", {{"Origin", "https://elsewhere.example"}});
    EXPECT_EQ(read.fields.at("Access-Control-Allow-Origin"), "https://elsewhere.example");
    const HttpReply preflight = test::ask(open.port(), "OPTIONS", "/v1/sessions",
                                          {{"Origin", "https://elsewhere.example"}, {"Access-Control-Request-Method", "POST"}});
    EXPECT_EQ(preflight.status, 204U);
    EXPECT_THAT(preflight.fields.at("Access-Control-Allow-Methods"), HasSubstr("POST"));
    for (const char* field :
         {"Authorization", "Content-Type", "If-Match", "If-None-Match", "If-Range", "Range", "X-Request-Id", "traceparent"}) {
        EXPECT_THAT(preflight.fields.at("Access-Control-Allow-Headers"), HasSubstr(field));
    }
    for (const char* field : {"Accept-Ranges", "Content-Disposition", "Content-Range", "ETag", "Retry-After", "WWW-Authenticate",
                              "X-Request-Id", "traceparent"}) {
        EXPECT_THAT(read.fields.at("Access-Control-Expose-Headers"), HasSubstr(field));
    }
    EXPECT_EQ(read.fields.count("X-Request-Id") + read.fields.count("traceparent"), 2U) << "and they are there";
    EXPECT_EQ(test::ask(open.port(), "GET", "/v1/sessions", {{"Origin", "https://third.example"}}).status, 403U);
}

// What a page of another site is after its name was pointed at this machine: of the same origin, to the browser.
TEST(RestHostTest, AServerThatTrustsWhoReachesItAnswersToItsOwnNamesAlone) {
    rest::RestOptions options;
    options.own_hosts_only = true;
    RestFixture server(small_server(), options);
    const auto ask_as = [&](const std::string& host) {
        HttpClient client(server.port());
        client.send(std::string("GET /v1/sessions HTTP/1.1\r\nHost: ").append(host).append("\r\n\r\n"));
        return client.read_reply();
    };
    EXPECT_TRUE(is_problem(ask_as("evil.example:8080"), 421, "INVALID_OPTION"));
    EXPECT_EQ(ask_as("127.0.0.1:8080").status, 200U);
    EXPECT_EQ(ask_as("localhost").status, 200U);
}

TEST(RestLimitsTest, LimitsThatPassAre429AndSayWhenToTryAgain) {
    service::ServiceOptions options = small_server();
    options.limits.sessions = 1;
    options.limits.upload_bytes = 10'000;
    RestFixture server(options);
    EXPECT_TRUE(is_problem(ask(server.port(), "POST", "/v1/sessions", {}, std::string(10'001, 'x')), 413, "LIMIT_EXCEEDED"));
    EXPECT_EQ(ask(server.port(), "POST", "/v1/sessions").status, 200U);
    const HttpReply second = ask(server.port(), "POST", "/v1/sessions");
    EXPECT_TRUE(is_problem(second, 429, "LIMIT_EXCEEDED"));
    EXPECT_EQ(second.fields.at("Retry-After"), json_at(second.body, "/retryAfter"));
}

TEST(RestLimitsTest, SlowAndSuperfluousClientsAreShutOut) {
    rest::RestOptions options;
    options.limits.header_time = std::chrono::milliseconds(200);
    options.limits.patience.stall = std::chrono::milliseconds(300);
    options.limits.idle_time = std::chrono::milliseconds(250);
    options.limits.connections = 3;
    options.limits.requests = 2;
    RestFixture server(small_server(), options);
    HttpClient slow_header(server.port());
    slow_header.send("GET / HT");
    EXPECT_EQ(slow_header.read_reply().status, 0U);
    HttpClient idle(server.port());
    EXPECT_EQ(idle.read_line(), "") << "closed";
    ASSERT_TRUE(eventually([&] { return ask(server.port(), "GET", "/healthz").status == 200; }));
    HttpClient a(server.port());
    EXPECT_EQ(a.ask("GET", "/healthz").status, 200U);
    EXPECT_EQ(a.ask("GET", "/healthz").fields.at("Connection"), "close") << "the last of its two";
    HttpClient b(server.port());
    HttpClient c(server.port());
    HttpClient d(server.port());
    EXPECT_TRUE(eventually([&] { return ask(server.port(), "GET", "/healthz").status == 503; }, std::chrono::milliseconds(200)));
}

TEST(RestLimitsTest, ABodyThatStallsIsAnswered) {
    rest::RestOptions options;
    options.limits.patience.stall = std::chrono::milliseconds(300);
    RestFixture server(small_server(), options);
    const std::string id = session_with(server.grpc().stub(), cube());
    const std::string session = "/v1/sessions/" + id;
    struct Stalling {
        std::string target;
        const char* rest;
    };
    for (const auto& [target, rest] : {
             Stalling{"POST /v1/sessions", "Content-Length: 10\r\n\r\nab"},
             Stalling{"PUT " + session + "/mesh", "Transfer-Encoding: chunked\r\n\r\n5\r\nab"},
             Stalling{"PUT " + session + "/mesh", "Content-Length: 10\r\nExpect: 100-continue\r\n\r\n"},
             Stalling{"POST " + session + ":improve", "Content-Length: 10\r\nContent-Type: application/json\r\n\r\n{"},
             Stalling{"GET /v1/sessions", "Content-Length: 10\r\n\r\n"},
         }) {
        const std::string request = std::string(target).append(" HTTP/1.1\r\nHost: t\r\n").append(rest);
        HttpClient client(server.port());
        client.send(request);
        const HttpReply reply = client.read_reply();
        EXPECT_TRUE(is_problem(reply, 408, "DEADLINE_EXCEEDED")) << request;
        EXPECT_EQ(reply.fields.at("Connection"), "close");
        EXPECT_EQ(client.read_line(), "") << "closed";
    }
    EXPECT_EQ(server.grpc().service().load().sessions, 1U) << "what stalled left none behind";
    EXPECT_EQ(json_at(ask(server.port(), "GET", "/v1/sessions/" + id).body, "/source/faces"), "12");
}

TEST(RestLimitsTest, AJsonBodyCountsOnceHoweverItComes) {
    rest::RestOptions options;
    options.limits.all_json_bytes = std::uint64_t{1} << 20;
    RestFixture server(small_server(), options);
    HttpClient client(server.port());
    const std::string body = "{}" + std::string(2000, ' ');
    client.send("POST /v1/sessions HTTP/1.1\r\nHost: t\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n");
    client.send(chunked(body, 1));
    EXPECT_EQ(client.read_reply().status, 200U);
}

TEST(RestShutdownTest, LetsWhatIsBeingAnsweredEnd) {
    RestFixture server;
    HttpClient idle(server.port());
    EXPECT_EQ(idle.ask("GET", "/healthz").status, 200U);
    const std::string id = session_with(server.grpc().stub(), icosphere(3));
    HttpClient client(server.port());
    const std::string body = R"({"options": {"faces": 600, "tolerance": 0.05}})";
    client.send("POST /v1/sessions/" + id + ":improve HTTP/1.1\r\nHost: t\r\nContent-Length: " + std::to_string(body.size()) +
                "\r\n\r\n" + body);
    ASSERT_TRUE(eventually([&] {
        return server.grpc().service().load().methods_running == 1 ||
               !get_session(server.grpc().stub(), id).message.representations().empty();
    }));
    std::thread stop([&] { server.rest().shutdown(std::chrono::seconds(20)); });
    EXPECT_EQ(client.read_reply().status, 200U);
    EXPECT_EQ(idle.read_line(), "") << "closed";
    stop.join();
}

}  // namespace
}  // namespace vsplit::test
