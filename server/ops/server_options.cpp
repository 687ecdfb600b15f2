#include "ops/server_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <regex>
#include <string_view>
#include <utility>
#include <vector>

#include "ops/log_line.h"
#include "ops/number_range.h"

namespace vsplit::ops {
namespace {

// Further ahead than this the clock's arithmetic would overflow; it is a century.
constexpr std::int64_t kLongestTtl = std::int64_t{100} * 366 * 24 * 3600;

constexpr unsigned kMostThreads = 1024;
constexpr std::uint32_t kDay = 24 * 3600;
constexpr std::uint32_t kMostStreams = std::uint32_t{1} << 30;
constexpr std::uint32_t kLeastMessageBytes = std::uint32_t{1} << 19;  // twice what clients put a mesh into
constexpr std::uint64_t kMessagesInMemory = 16;
constexpr std::uint32_t kMostMessageBytes = std::uint32_t{1} << 30;

// gRPC is to have room for some of the largest messages at once, or it could not take one.
Status check_message_memory(const ServerOptions& options) {
    constexpr std::uint64_t kAtLeast = 4;
    if (options.max_message_memory >= kAtLeast * options.max_message_bytes) return Done{};
    return Error{Cause::kInvalidOption,
                 "max-message-memory-bytes is " + std::to_string(options.max_message_memory) +
                     "; accepted are 0 and four times max-message-bytes or more, " +
                     std::to_string(kAtLeast * options.max_message_bytes),
                 "max-message-memory-bytes"};
}

// What no option says alone.
Status check_together(const ServerOptions& options) {
    if (options.max_disk_bytes > 0 && options.data_dir.empty()) {
        return Error{Cause::kInvalidOption,
                     "max-disk-bytes is " + std::to_string(options.max_disk_bytes) +
                         ", but there is no data-dir; accepted without one is 0",
                     "max-disk-bytes"};
    }
    return check_message_memory(options);
}

bool takes_free_port(std::string_view listen) { return listen.size() > 2 && listen.substr(listen.size() - 2) == ":0"; }

// What there is to say on the command line, and where it goes.
class Parser {
public:
    Parser() {
        app_.option_defaults()->always_capture_default();
        app_.set_version_flag("--version", "vsplitd " VSPLIT_VERSION);
        app_.set_config("--config", "", "Read options from this file: TOML, a line `name = value` for each --name");
        app_.allow_config_extras(CLI::config_extras_mode::error);
        add_doors();
        add_guard();
        add_work();
        add_limits();
        add_life();
        app_.footer(
            "What the command line leaves out is taken from the environment, VSPLITD_LISTEN for --listen and so on,\n"
            "and what that leaves out from the file of --config.");
    }

    CLI::App& app() { return app_; }
    [[nodiscard]] bool print_config() const { return print_config_; }

    ServerOptions options() {
        options_.service.session_ttl = std::chrono::seconds(ttl_);
        if (options_.max_message_memory == 0) {
            options_.max_message_memory = kMessagesInMemory * std::uint64_t{options_.max_message_bytes};
        }
        std::erase(options_.rest.cors_origins, "");  // how a file says that there is none
        // Who asks for a free port wants to be in nobody's way.
        if (http_->empty() && takes_free_port(options_.listen)) options_.http = "127.0.0.1:0";
        return options_;
    }

private:
    void add_doors() {
        app_.add_option("--listen", options_.listen, "HOST:PORT to serve gRPC at; port 0 takes a free one");
        http_ =
            app_.add_option("--http", options_.http, "HOST:PORT to serve REST at, or off; a free port where --listen takes one");
        app_.add_option(
                "--cors-origin", options_.rest.cors_origins,
                "Origin of web pages that may use REST, e.g. https://example.org, or *; several are allowed. Default: none")
            ->delimiter(',')
            ->default_str("")
            ->option_text("ORIGIN ...");
        app_.add_flag("--print-openapi", options_.print_openapi, "Print the OpenAPI document and end")->configurable(false);
        app_.add_flag("--check", options_.check, "Ask the server at --listen whether it serves; ends with 0 if so")
            ->configurable(false);
        app_.add_flag("--print-config", print_config_, "Print what holds, as a file for --config, and end")->configurable(false);
    }

    void add_guard() {
        constexpr const char* kGroup = "Access";
        app_.add_option("--tls-cert", options_.tls.cert, "Certificate (PEM) for TLS at both doors; read again when it changes")
            ->group(kGroup);
        app_.add_option("--tls-key", options_.tls.key, "Its private key (PEM)")->group(kGroup);
        app_.add_option("--tls-client-ca", options_.tls.client_ca,
                        "Authorities (PEM) one of which must have signed the certificate that a client shows: mutual TLS")
            ->group(kGroup);
        app_.add_option("--token-file", options_.token_file,
                        "Tokens that calls must carry, a line each as --new-token prints it; read again when it changes")
            ->group(kGroup);
        app_.add_option("--new-token", options_.new_token, "Make a token NAME:read-only or NAME:read-write, print it, and end")
            ->configurable(false)
            ->group(kGroup);
        app_.add_flag("--insecure", options_.insecure, "Listen beyond this machine without TLS or without tokens")->group(kGroup);
    }

    void add_work() {
        app_.add_option("--workers", options_.service.workers, "Methods that run at a time; 0: one a core")
            ->check(number_range(0U, kMostThreads));
        app_.add_option("--threads", options_.service.threads, "Threads of one method; 0: all cores")
            ->check(number_range(0U, kMostThreads));
        app_.add_option("--data-dir", options_.data_dir,
                        "Directory to keep sessions in, so that they outlive the server. Default: they do not");
        app_.add_option("--session-ttl", ttl_, "Seconds that an unused session lives")
            ->check(number_range(std::int64_t{1}, kLongestTtl));
        app_.add_option("--log-level", options_.log_level, "What is logged to stderr")
            ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}).description(""))
            ->option_text("LEVEL=info: debug, info, warning, error or off");
        app_.add_option("--log-format", options_.log_format, "How: lines of text, or a JSON object a line")
            ->check(CLI::IsMember({"text", "json"}).description(""))
            ->option_text("text|json");
        app_.add_option("--slow-job", options_.slow_job, "Seconds; a method that takes longer is logged as a warning. 0: none")
            ->check(number_range(0.0, 1e9));
    }

    void add_limits() {
        constexpr const char* kGroup = "Limits";
        service::Limits& limits = options_.service.limits;
        const auto add_within = [this](const CLI::Validator& range, const char* name, auto& value, const char* help) {
            app_.add_option(name, value, help)->group(kGroup)->check(range);
        };
        const auto add = [&](const char* name, auto& value, const char* help, std::uint32_t least = 1) {
            using Number = std::remove_reference_t<decltype(value)>;
            add_within(number_from(Number{least}), name, value, help);
        };
        add("--max-upload-bytes", limits.upload_bytes, "Bytes of an uploaded file");
        add("--max-faces", limits.faces, "Faces of an uploaded mesh");
        add("--max-faces-subdivided", limits.faces_subdivided, "Faces of a mesh after subdivision");
        add("--max-sessions", limits.sessions, "Sessions at a time");
        add("--max-sessions-by-client", limits.sessions_by_client, "Sessions of one token at a time");
        add("--max-representations", limits.representations, "Representations of a session");
        add("--max-waiting", limits.waiting_jobs, "Requests that wait in a session while one runs", 0);
        add("--max-queued", limits.queued_jobs, "Requests that wait in all sessions together");
        add("--max-job-seconds", limits.job_seconds, "Seconds that one method runs");
        add("--max-memory-bytes", limits.memory_bytes,
            "Bytes of meshes, representations and methods in memory; 0: three quarters of what there is", 0);
        add("--max-disk-bytes", options_.max_disk_bytes, "Bytes of meshes and representations in --data-dir; 0: no limit", 0);
        add("--max-rpcs", options_.max_rpcs, "Rpcs at a time");
        add_within(number_range(1U, kMostStreams), "--max-streams", options_.max_streams,
                   "Rpcs of one gRPC connection at a time; more wait at the client");
        add_within(number_range(kLeastMessageBytes, kMostMessageBytes), "--max-message-bytes", options_.max_message_bytes,
                   "Bytes of one gRPC message");
        add("--max-message-memory-bytes", options_.max_message_memory,
            "Bytes of gRPC messages on their way in, of all connections; 0: sixteen of the largest", 0);
        add("--max-connections", options_.rest.limits.connections, "Connections at a time, by gRPC and by HTTP each");
        add_within(zero_or(number_range(0.001, 1e9)), "--max-request-rate", options_.max_request_rate,
                   "Requests a second of one client, a token or else an address, and twice as many at once; 0: no limit");
    }

    void add_life() {
        app_.add_option("--drain", options_.drain, "Seconds that what runs has to end after SIGTERM")
            ->check(number_range(0U, kDay));
        app_.add_option("--keepalive", options_.keepalive,
                        "Seconds of silence before a gRPC client is asked for a sign of life, 20 s to answer; 0: never")
            ->check(number_range(0U, kDay));
        app_.add_option("--max-connection-age", options_.max_connection_age,
                        "Seconds after which a gRPC client is told to connect anew, when its rpcs are done; 0: never")
            ->check(number_range(0U, 20 * kDay));
    }

    ServerOptions options_;
    std::int64_t ttl_ = std::chrono::duration_cast<std::chrono::seconds>(options_.service.session_ttl).count();
    bool print_config_ = false;
    const CLI::Option* http_ = nullptr;
    CLI::App app_{"vsplitd: serves vsplit.v1.Meshing over gRPC, with health and reflection, and over HTTP with JSON", "vsplitd"};
};

std::string variable_of(const std::string& option) {
    std::string name = "VSPLITD_" + option;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c == '-' ? '_' : static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c); });
    return name;
}

bool is_given(const std::vector<std::string>& arguments, const std::string& option) {
    return std::any_of(arguments.begin(), arguments.end(), [&](const std::string& argument) {
        return argument == "--" + option || argument.starts_with("--" + option + '=');
    });
}

// CLI11 would let a file win over the environment.
void add_environment(CLI::App& app, const Environment& environment, std::vector<std::string>& arguments) {
    std::vector<std::string> more;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_lnames().empty()) continue;
        const std::string& name = option->get_lnames().front();
        if ((!option->get_configurable() && name != "config") || is_given(arguments, name)) continue;
        const std::string value = environment(variable_of(name)).value_or("");
        if (value.empty()) continue;  // after a bare "=" CLI11 would take the next argument
        more.push_back("--" + name + '=');
        more.back() += value;
    }
    arguments.insert(arguments.begin(), more.begin(), more.end());
}

/// The value of the last of an option's; nothing where it is not among them.
std::optional<std::string> value_of(const std::vector<std::string>& arguments, const std::string& option) {
    std::optional<std::string> value;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (arguments[i].starts_with(option + '=')) value = arguments[i].substr(option.size() + 1);
        if (arguments[i] == option && i + 1 < arguments.size()) value = arguments[i + 1];
    }
    return value;
}

// Before anything is parsed: for what is wrong with the rest.
bool asks_for_json(const std::vector<std::string>& arguments) {
    if (const auto format = value_of(arguments, "--log-format")) return format == "json";
    std::ifstream file(value_of(arguments, "--config").value_or(""));
    const std::regex says_json("\\s*log-format\\s*=\\s*[\"']?json[\"']?\\s*");
    for (std::string line; std::getline(file, line);) {
        if (std::regex_match(line, says_json)) return true;
    }
    return false;
}

/// Where a wrong value came from, which CLI11 does not tell: its words have the option's name.
std::string source_of(const std::string& told, const std::vector<std::string>& given, const std::vector<std::string>& all) {
    const std::size_t first = std::min(told.find("--"), told.size());
    const std::string option = told.substr(first, told.find_first_of(": ", first) - first);
    const auto is_in = [&option](const std::vector<std::string>& arguments) { return value_of(arguments, option).has_value(); };
    if (!option.starts_with("--") || is_in(given)) return "";
    if (is_in(all)) return variable_of(option.substr(2)) + " of the environment: ";
    const auto file = value_of(all, "--config");
    return file ? *file + ": " : "";
}

std::string names_of(const CLI::App& app) {
    std::string names;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_configurable() && !option->get_lnames().empty())
            names += (names.empty() ? "" : ", ") + option->get_lnames().front();
    }
    return names;
}

/// CLI11 speaks of INI, and of a section as of an option.
std::string config_problem(const std::string& file, const CLI::ConfigError& error, const CLI::App& app) {
    std::string name = error.what();
    const std::size_t parse = name.find("parse ");
    if (parse != std::string::npos) name = name.substr(parse + std::string_view("parse ").size());
    const std::size_t section = name.find(".++");
    const std::string what = section == std::string::npos
                                 ? "no option is called '" + name + "'"
                                 : "it has a section [" + name.substr(0, section) + "], and options are in none";
    return file + ": " + what + "; accepted are " + names_of(app);
}

}  // namespace

std::optional<std::string> process_environment(const std::string& name) {
    const char* const value = std::getenv(name.c_str());
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::variant<ServerOptions, int> parse_server_options(int argc, const char* const* argv, const Environment& environment) {
    Parser parser;
    const std::vector<std::string> given(argv + std::min(argc, 1), argv + argc);
    std::vector<std::string> arguments = given;
    add_environment(parser.app(), environment, arguments);
    const bool json = asks_for_json(arguments);
    try {
        parser.app().parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // as CLI11 wants them
    } catch (const CLI::ConfigError& error) {
        return say_failure(config_problem(value_of(arguments, "--config").value_or("the configuration"), error, parser.app()),
                           json),
               1;
    } catch (const CLI::ParseError& error) {
        const std::string source = source_of(error.what(), given, arguments);
        if (error.get_exit_code() != 0 && (json || !source.empty())) return say_failure(source + error.what(), json), 1;
        return parser.app().exit(error, std::cout, std::cerr) == 0 ? 0 : 1;
    }
    if (Status fits = check_together(parser.options()); !fits) return say_failure(fits.error().message, json), 1;
    if (parser.print_config()) {
        std::cout << parser.app().config_to_str(true, false);
        return 0;
    }
    return parser.options();
}

Expected<ServerOptions> parse_config(std::istream& text) {
    Parser parser;
    try {
        parser.app().parse_from_stream(text);
    } catch (const CLI::Error& error) {
        return Error{Cause::kInvalidOption, error.what(), "config"};
    }
    const ServerOptions options = parser.options();
    if (Status fits = check_together(options); !fits) return fits.error();
    return options;
}

}  // namespace vsplit::ops
