"""A mesh file that was downloaded."""

from .decoder import CorruptError


class MeshFile(bytes):
    """The bytes of a file, and what the server says of it: `name`, `content_type`, `faces`, `nodes_on_chord` (of order 2: edges
    whose node stays in the middle of the chord), `digest` (SHA-256, hexadecimal)."""

    @classmethod
    def of_chunks(cls, chunks):
        """Of the MeshChunk messages of a stream, in order."""
        parts, first = [], None
        for chunk in chunks:
            first = first or chunk
            parts.append(chunk.data)
        made = cls(b"".join(parts))
        if first is None or len(made) != first.size:
            raise CorruptError(f"{len(made)} bytes of a mesh file came, expected are {first.size if first else 'some'}")
        made.name, made.content_type, made.faces = first.file_name, first.content_type, first.faces
        made.nodes_on_chord, made.digest = first.nodes_on_chord, first.digest
        return made
