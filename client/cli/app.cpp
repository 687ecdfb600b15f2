#include "cli/app.h"

#include <grpc/support/log.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <type_traits>
#include <variant>

#include "cli/arguments.h"
#include "cli/comparison.h"
#include "cli/interrupt.h"
#include "cli/local_run.h"
#include "cli/message.h"
#include "cli/outcome.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/remote_run.h"
#include "cli/report.h"
#include "cli/size_field_file.h"
#include "vsplit/base/execution_context.h"
#include "wire/json.h"

namespace vsplit::cli {
namespace {

std::string json_of(const Document& document) {
    if (const auto* comparison = std::get_if<Comparison>(&document)) return to_json(*comparison);
    return std::visit(
        [](const auto& message) -> std::string {
            if constexpr (std::is_same_v<decltype(message), const Comparison&>)
                return {};
            else
                return wire::to_json(message, wire::JsonStyle::kIndented);
        },
        document);
}

void print(const Arguments& arguments, const Outcome& outcome) {
    if (arguments.json) {
        std::cout << json_of(outcome.document) << std::flush;
    } else {
        std::cout << report(outcome.document, arguments.verb == Verb::kQuality) << written_lines(arguments.outputs) << std::flush;
    }
}

bool runs_method(Verb verb) { return verb == Verb::kImprove || verb == Verb::kControl; }

/// What the exit status does not say but a person should know.
void print_notes(const Arguments& arguments, const v1::Representation& made) {
    const std::optional<std::uint32_t> asked = asked_faces(arguments);
    if (asked) std::cerr << nearest_note(*asked, made);
    if (runs_method(arguments.verb)) std::cerr << finding_messages(made) << violation_messages(made);
}

int finish(const Arguments& arguments, const Outcome& outcome) {
    print(arguments, outcome);
    if (!std::cout) {
        std::cerr << error_message({Cause::kFileAccess, "cannot write to the standard output", ""});
        return kExitFailed;
    }
    std::cerr << outcome.note;
    const auto* made = std::get_if<v1::Representation>(&outcome.document);
    if (made == nullptr) return kExitDone;
    print_notes(arguments, *made);
    return runs_method(arguments.verb) && !made->bounds_satisfied() ? kExitBoundBroken : kExitDone;
}

int fail(const Error& error) {
    std::cerr << error_message(error);
    return kExitFailed;
}

Expected<Outcome> execute(const Arguments& arguments, const std::vector<Output>& outputs, const InterruptWatch& interrupt) {
    ProgressBar progress(arguments.no_progress ? ProgressBar::Shown::kNever : ProgressBar::Shown::kOnTerminals);
    Expected<Outcome> outcome = arguments.server.empty() ? run_locally(arguments, outputs, progress, interrupt.token())
                                                         : run_on_server(arguments, outputs, progress, interrupt.token());
    if (!outcome) return outcome;
    if (interrupt.token().stop_requested()) return ExecutionContext::cancelled_error();
    if (Status written = write_outputs(*outcome, outputs, arguments); !written) return written.error();
    return outcome;
}

/// What gRPC writes of itself beside the message; who looks for a fault in it has GRPC_VERBOSITY.
void silence_grpc() {
    if (std::getenv("GRPC_VERBOSITY") == nullptr) gpr_set_log_function([](gpr_log_func_args*) {});
}

int run_parsed(const Arguments& arguments) {
    const Expected<std::vector<Output>> outputs = plan_outputs(arguments);
    if (!outputs) return fail(outputs.error());
    const InterruptWatch interrupt;
    const Expected<Outcome> outcome = execute(arguments, *outputs, interrupt);
    return outcome ? finish(arguments, *outcome) : fail(outcome.error());
}

}  // namespace

int run(int argc, const char* const* argv) {
    silence_grpc();
    try {
        std::variant<Arguments, int> parsed = parse(argc, argv);
        if (const int* exit_status = std::get_if<int>(&parsed)) return *exit_status;
        if (Status read = read_size_field_into(std::get<Arguments>(parsed)); !read) return fail(read.error());
        return run_parsed(std::get<Arguments>(parsed));
    } catch (const std::bad_alloc&) {
        return fail({Cause::kLimitExceeded,
                     "not enough memory for this mesh; ask for a coarser subdivision, or use a larger machine", ""});
    } catch (const std::exception& e) {
        return fail({Cause::kInternal, e.what(), ""});
    }
}

}  // namespace vsplit::cli
