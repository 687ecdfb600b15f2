"""A channel, with TLS and a token where the server wants them."""

import collections
import pathlib

import grpc


class _Details(
        collections.namedtuple("_Details", "method timeout metadata credentials wait_for_ready compression"), grpc.ClientCallDetails):
    """What grpc lets an interceptor change."""


class _Token(grpc.UnaryUnaryClientInterceptor, grpc.UnaryStreamClientInterceptor, grpc.StreamUnaryClientInterceptor,
             grpc.StreamStreamClientInterceptor):
    """Puts the token on every call, of whatever shape."""

    def __init__(self, token):
        self._mark = ("authorization", "Bearer " + token)

    def _marked(self, continuation, details, request):
        metadata = [*(details.metadata or []), self._mark]
        return continuation(
            _Details(details.method, details.timeout, metadata, details.credentials, details.wait_for_ready, details.compression),
            request)

    intercept_unary_unary = intercept_unary_stream = intercept_stream_unary = intercept_stream_stream = _marked


def _read(path):
    return pathlib.Path(path).read_bytes() if path else None


def open_channel(target, options, token, tls_ca, tls_cert, tls_key):
    if tls_ca:
        credentials = grpc.ssl_channel_credentials(_read(tls_ca), _read(tls_key), _read(tls_cert))
        channel = grpc.secure_channel(target, credentials, options)
    else:
        channel = grpc.insecure_channel(target, options)
    return grpc.intercept_channel(channel, _Token(token)) if token else channel
