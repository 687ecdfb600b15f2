// Tells ThreadSanitizer how gRPC hands work from thread to thread.
//
// Debian's libgrpc and abseil are not instrumented, so the sanitizer does not see that what a thread did before it started an
// operation comes before what another one does when that operation is complete, nor that abseil's mutex is a mutex, and would
// call every such pair a race. These functions stand in front of theirs and state exactly that: start_batch(tag) comes before the
// completion of the same tag, an unlock before the next lock of the same mutex. Nothing else is ordered by them.
#include <dlfcn.h>
#include <grpc/grpc.h>
#include <sanitizer/tsan_interface.h>

#include "absl/synchronization/mutex.h"

namespace {

template <class Function>
Function* original(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

grpc_event completed(grpc_event event) {
    if (event.type == GRPC_OP_COMPLETE && event.tag != nullptr) __tsan_acquire(event.tag);
    return event;
}

}  // namespace

extern "C" {

grpc_call_error grpc_call_start_batch(grpc_call* call, const grpc_op* ops, size_t nops, void* tag, void* reserved) {
    static auto* const start = original<decltype(grpc_call_start_batch)>("grpc_call_start_batch");
    if (tag != nullptr) __tsan_release(tag);
    return start(call, ops, nops, tag, reserved);
}

grpc_event grpc_completion_queue_next(grpc_completion_queue* queue, gpr_timespec deadline, void* reserved) {
    static auto* const next = original<decltype(grpc_completion_queue_next)>("grpc_completion_queue_next");
    return completed(next(queue, deadline, reserved));
}

grpc_event grpc_completion_queue_pluck(grpc_completion_queue* queue, void* tag, gpr_timespec deadline, void* reserved) {
    static auto* const pluck = original<decltype(grpc_completion_queue_pluck)>("grpc_completion_queue_pluck");
    return completed(pluck(queue, tag, deadline, reserved));
}

}  // extern "C"

void absl::Mutex::Lock() {
    static auto* const lock = original<void(absl::Mutex*)>("_ZN4absl7debian35Mutex4LockEv");
    lock(this);
    __tsan_acquire(this);
}

void absl::Mutex::Unlock() {
    static auto* const unlock = original<void(absl::Mutex*)>("_ZN4absl7debian35Mutex6UnlockEv");
    __tsan_release(this);
    unlock(this);
}

bool absl::Mutex::TryLock() {
    static auto* const try_lock = original<bool(absl::Mutex*)>("_ZN4absl7debian35Mutex7TryLockEv");
    const bool locked = try_lock(this);
    if (locked) __tsan_acquire(this);
    return locked;
}
