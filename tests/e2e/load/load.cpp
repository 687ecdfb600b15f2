// load HOST:PORT MESH CLIENTS SECONDS [ROUNDS PID]: many clients at once that upload, improve, control, read, download and
// delete.
//
// Prints what the calls took and how they ended, and fails where one ended otherwise than well or by a limit that is named, or
// where 99 of 100 GetSessions took longer than 50 ms, and what the machine alone makes a thread wait. With ROUNDS and the
// server's PID also its memory after each round, and fails where that grows.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "vsplit/client/meshing_client.h"

namespace vsplit {
namespace {

using Clock = std::chrono::steady_clock;

// After a refusal; Retry-After asks for more.
constexpr std::chrono::milliseconds kPause(200);

constexpr double kSize = 20;          // subdivision of the bracket, whose box is 228 across: a second of work
constexpr double kMostP99 = 50;       // ms, of GetSession
constexpr double kMostGrowth = 1.15;  // of memory, from the second round to the last
constexpr double kMostGrowthMb = 64;  // or this

// What happened, by name of the call. Thread-safe.
class Tally {
public:
    void note(const std::string& call, double ms, const Error* error) {
        const std::lock_guard lock(mutex_);
        if (error == nullptr) {
            took_[call].push_back(ms);
        } else if (error->cause == Cause::kLimitExceeded) {
            ++refused_[call];
        } else {
            failures_.push_back(call + ": " + std::string(cause_name(error->cause)) + ": " + error->message);
        }
    }

    // Whether all is well.
    bool report(double delay) {
        std::printf("%-14s %8s %8s %9s %9s %9s ms\n", "call", "well", "refused", "half", "99 %", "longest");
        bool well = failures_.empty();
        for (auto& [call, took] : took_) {
            std::sort(took.begin(), took.end());
            const auto at = [&took = took](double part) {
                return took[static_cast<std::size_t>(part * static_cast<double>(took.size() - 1))];
            };
            std::printf("%-14s %8zu %8zu %9.1f %9.1f %9.1f\n", call.c_str(), took.size(), refused_[call], at(0.5), at(0.99),
                        took.back());
            if (call == "GetSession" && at(0.99) > kMostP99 + delay) well = false;
        }
        for (const std::string& failure : failures_) std::printf("failed: %s\n", failure.c_str());
        return well && !took_.empty();
    }

private:
    std::mutex mutex_;
    std::map<std::string, std::vector<double>> took_;
    std::map<std::string, std::size_t> refused_;
    std::vector<std::string> failures_;
};

// One client: a session at a time, from its making to its end.
class Worker {
public:
    Worker(const std::string& target, std::span<const std::byte> mesh, Tally& tally, unsigned number)
        : client_(client::MeshingClient::connect(target)),
          mesh_(mesh),
          tally_(tally),
          number_(number),
          file_("load_" + std::to_string(number) + ".stl") {}
    ~Worker() { std::remove(file_.c_str()); }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

private:
    template <class Call>
    auto timed(const char* name, const Call& call) {
        const auto start = Clock::now();
        auto result = call();
        const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        const bool cut_off = !result && call_.stop.stop_requested() && result.error().cause == Cause::kCancelled;
        if (!cut_off) tally_.note(name, ms, result ? nullptr : &result.error());
        return result;
    }

public:
    /// Until `stop`, which cuts off what it finds under way.
    void run(const std::stop_token& stop) {
        call_.stop = stop;
        if (!client_) return tally_.note("connect", 0, &client_.error());
        while (!stop.stop_requested()) {
            const auto session = timed("CreateSession", [&] { return client_->create_session(call_); });
            if (!session) {
                std::this_thread::sleep_for(kPause);
                continue;
            }
            work_in(session->id());
            static_cast<void>(timed("DeleteSession", [&] { return client_->delete_session(session->id()); }));
        }
    }

private:
    void look(const std::string& session, int times) {
        for (int i = 0; i < times; ++i)
            static_cast<void>(timed("GetSession", [&] { return client_->get_session(session, call_); }));
    }

    Expected<v1::Representation> improve(const std::string& session) {
        v1::ImproveRequest request;
        request.set_session(session);
        request.mutable_options()->set_mode(v1::STRICT);
        request.mutable_options()->set_subdivision_size(kSize);
        return timed("Improve", [&] { return client_->improve(request, {}, call_); });
    }

    Expected<v1::Representation> control(const std::string& session) {
        v1::ControlRequest request;
        request.set_session(session);
        request.mutable_options()->set_mode(v1::STRICT);
        return timed("Control", [&] { return client_->control(request, {}, call_); });
    }

    void work_in(const std::string& session) {
        if (!timed("UploadMesh", [&] { return client_->upload_mesh(session, mesh_, {}, call_); })) return;
        look(session, 5);
        const Expected<v1::Representation> made = number_ % 2 == 0 ? improve(session) : control(session);
        look(session, 5);
        if (!made) return std::this_thread::sleep_for(kPause);
        v1::SetResolutionRequest resolution;
        resolution.set_session(session);
        resolution.set_representation(made->id());
        resolution.set_faces(made->faces_max());
        static_cast<void>(timed("SetResolution", [&] { return client_->set_resolution(resolution, {}, call_); }));
        v1::DownloadMeshRequest download;
        download.set_session(session);
        static_cast<void>(timed("DownloadMesh", [&] { return client_->download_mesh(download, file_, call_); }));
        v1::GetQualityRequest quality;
        quality.set_session(session);
        static_cast<void>(timed("GetQuality", [&] { return client_->get_quality(quality, call_); }));
        v1::ListSessionsRequest list;
        list.set_page_size(10);
        static_cast<void>(timed("ListSessions", [&] { return client_->list_sessions(list, call_); }));
    }

    Expected<client::MeshingClient> client_;
    client::CallOptions call_;
    std::span<const std::byte> mesh_;
    Tally& tally_;
    const unsigned number_;
    const std::string file_;
};

double resident_mb(const std::string& pid) {
    std::ifstream status("/proc/" + pid + "/status");
    std::string word;
    while (status >> word) {
        double kilobytes = 0;
        if (word == "VmRSS:" && status >> kilobytes) return kilobytes / 1024;
    }
    return 0;
}

// How long after its time a thread runs that sleeps for 1 ms, until `stop`: on a machine that others use too, no server is
// faster. ms, of 99 in 100.
double machine_delay(const std::stop_token& stop) {
    std::vector<double> late;
    while (!stop.stop_requested()) {
        const auto start = Clock::now();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        late.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count() - 1);
    }
    std::sort(late.begin(), late.end());
    return late.empty() ? 0 : late[late.size() * 99 / 100];
}

bool one_round(const std::string& target, std::span<const std::byte> mesh, unsigned clients, double seconds) {
    Tally tally;
    std::stop_source stop;
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < clients; ++i) threads.emplace_back([&, i] { Worker(target, mesh, tally, i).run(stop.get_token()); });
    double delay = 0;
    std::thread watch([&] { delay = machine_delay(stop.get_token()); });
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    stop.request_stop();
    for (std::thread& thread : threads) thread.join();
    watch.join();
    std::printf("the machine lets 99 of 100 threads wait up to %.1f ms\n", delay);
    return tally.report(delay);
}

bool is_flat(const std::vector<double>& memory) {
    if (memory.size() < 3) return true;
    const double first = memory[1];  // the first round warms up what is kept
    const double last = *std::max_element(memory.end() - 2, memory.end());
    return last <= std::max(first * kMostGrowth, first + kMostGrowthMb);
}

int run(const std::vector<std::string>& arguments) {
    if (arguments.size() != 4 && arguments.size() != 6) {
        std::cerr << "usage: load HOST:PORT MESH CLIENTS SECONDS [ROUNDS PID]\n";
        return 1;
    }
    std::ifstream file(arguments[1], std::ios::binary);
    const std::string mesh{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const unsigned clients = static_cast<unsigned>(std::stoul(arguments[2]));
    const int rounds = arguments.size() == 6 ? std::stoi(arguments[4]) : 1;
    std::vector<double> memory;
    bool well = !mesh.empty();
    for (int round = 0; round < rounds; ++round) {
        well = one_round(arguments[0], std::as_bytes(std::span(mesh)), clients, std::stod(arguments[3])) && well;
        if (arguments.size() == 6) memory.push_back(resident_mb(arguments[5]));
        if (!memory.empty()) std::printf("memory after round %d: %.0f MB\n", round + 1, memory.back());
    }
    if (!is_flat(memory)) std::printf("memory grows\n");
    return well && is_flat(memory) ? 0 : 1;
}

}  // namespace
}  // namespace vsplit

int main(int argc, char** argv) { return vsplit::run({argv + 1, argv + argc}); }
