#include "rest_client.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::test {
namespace http = rest::http;
namespace net = rest::net;

HttpClient::HttpClient(int port) : socket_(context_) {
    socket_.connect({net::ip::address_v4::loopback(), static_cast<std::uint16_t>(port)});
    timeval longest{60, 0};  // no test waits for ever
    setsockopt(socket_.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
}

void HttpClient::send(std::string_view bytes) {
    rest::ErrorCode ignored;  // a server that has answered already may have closed
    net::write(socket_, net::buffer(bytes.data(), bytes.size()), ignored);
}

HttpReply HttpClient::read_reply(bool to_head) {
    HttpReply reply;
    rest::ErrorCode failed;
    for (bool interim = true; interim;) {
        http::response_parser<http::string_body> parser;
        parser.body_limit(std::uint64_t{1} << 30);
        parser.skip(to_head);
        http::read(socket_, buffer_, parser, failed);
        if (!parser.is_header_done()) return reply;
        reply.status = parser.get().result_int();
        interim = reply.status == 100;
        for (const auto& field : parser.get()) reply.fields[std::string(field.name_string())] = std::string(field.value());
        reply.body = parser.get().body();
        reply.whole = !failed;
    }
    return reply;
}

void HttpClient::begin(const std::string& method, const std::string& target, const Fields& fields, const std::string& body) {
    std::string text = method + ' ' + target + " HTTP/1.1\r\nHost: test\r\n";
    for (const auto& [name, value] : fields) text.append(name).append(": ").append(value).append("\r\n");
    if (!body.empty()) text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    send(text + "\r\n" + body);
}

HttpReply HttpClient::ask(const std::string& method, const std::string& target, const Fields& fields, const std::string& body) {
    begin(method, target, fields, body);
    return read_reply(method == "HEAD");
}

std::string HttpClient::read_line() {
    std::string line;
    char c = 0;
    rest::ErrorCode failed;
    while (net::read(socket_, net::buffer(&c, 1), failed) == 1 && c != '\n') line += c;
    return line;
}

void HttpClient::close() { socket_.close(); }

HttpReply ask(int port, const std::string& method, const std::string& target, const Fields& fields, const std::string& body) {
    return HttpClient(port).ask(method, target, fields, body);
}

RestFixture::RestFixture(const service::ServiceOptions& options, rest::RestOptions rest_options, const rpc::GrpcExtras& extras)
    : grpc_(options, extras) {
    rest::Backend backend;
    backend.channel = grpc_.server().channel();
    backend.descriptor_sets = {rest::contract_descriptors()};
    backend.services = {v1::Meshing::service_full_name()};
    backend.version = "test";
    backend.metrics = [] { return std::string("# nothing is counted here\n"); };
    if (extras.gate != nullptr) backend.admit = rest::admission_of(*extras.gate);
    auto started = rest::RestServer::start("127.0.0.1", "0", std::move(backend), std::move(rest_options), {});
    if (!started) {
        std::cerr << started.error().message << '\n';
        std::abort();  // no test can say anything without a server
    }
    rest_ = *std::move(started);
}

std::string json_at(const std::string& text, const std::string& pointer) {
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    const nlohmann::json::json_pointer place(pointer);
    if (json.is_discarded() || !json.contains(place)) {
        ADD_FAILURE() << "no " << pointer << " in " << text.substr(0, 500);
        return "";
    }
    const nlohmann::json& value = json[place];
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace vsplit::test
