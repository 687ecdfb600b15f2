"""Why a call failed, for programs."""

import collections

from google.rpc import error_details_pb2, status_pb2

Problem = collections.namedtuple("Problem", "cause message field retry_after")


def problem_of(error):
    """A Problem of the grpc.RpcError of a call.

    `cause`: e.g. "NON_MANIFOLD"; the name of the gRPC code where the server gave none, as when it was not reached. `field`: the
    option at fault, or "". `retry_after`: seconds after which the same request may well succeed, or None.
    """
    cause, field, retry_after = error.code().name, "", None
    for key, value in error.trailing_metadata() or ():
        if key != "grpc-status-details-bin":
            continue
        for detail in status_pb2.Status.FromString(value).details:
            info, retry = error_details_pb2.ErrorInfo(), error_details_pb2.RetryInfo()
            if detail.Unpack(info) and info.domain == "vsplit":
                cause, field = info.reason, info.metadata.get("field", "")
            elif detail.Unpack(retry):
                retry_after = retry.retry_delay.ToTimedelta().total_seconds()
    return Problem(cause, error.details(), field, retry_after)
