"""What a caller writes, as messages of the contract: the command line's words and the contract's names both stand for its enums."""

import numpy as np

# The command line's word where that is not the contract's name in small letters with hyphens.
_SYMBOLS = {"MICROMETRE": "um", "MILLIMETRE": "mm", "CENTIMETRE": "cm", "METRE": "m", "INCH": "in", "FOOT": "ft", "THREE_MF": "3mf"}


def word_of(enum, number):
    """The command line's word, e.g. "mm"; empty for 0, which stands for nothing. `enum`: its descriptor."""
    name = enum.values_by_number[number].name
    return _SYMBOLS.get(name, name.lower().replace("_", "-")) if number else ""


def number_of(enum, value):
    """The number for a word or a name, in letters of any size, or for the number itself; None is 0. ValueError for all else."""
    if value is None:
        return 0
    if isinstance(value, str) and value:
        wanted = value.lower().replace("_", "-")
        for known in enum.values:
            if wanted in (word_of(enum, known.number), known.name.lower().replace("_", "-")):
                return known.number
    elif isinstance(value, int) and not isinstance(value, bool) and value in enum.values_by_number:
        return value
    words = ", ".join(word_of(enum, known.number) for known in enum.values if known.number)
    names = ", ".join(known.name for known in enum.values if known.number)
    raise ValueError(f"{value!r} is none of {words}, nor of the names {names}")


def message_of(kind, fields):
    """A message of a class of the contract with fields by name; None leaves one out.

    A message in a field may be a dict, a Vector three numbers, and what repeats an array of any shape. ValueError for a field that
    there is not, or a word that stands for nothing; TypeError for a value of the wrong type. Both say which field.
    """
    return _filled(kind(), fields, "")


def _filled(message, fields, within):
    known = message.DESCRIPTOR.fields_by_name
    for name, value in fields.items():
        if name not in known:
            raise ValueError(f"{within}{name}: there is no such field; those of {message.DESCRIPTOR.name} are {', '.join(known)}")
        if value is not None:
            _put(message, known[name], value, within + name)
    return message


def _put(message, field, value, path):
    if field.message_type is not None:
        _put_messages(message, field, value, path)
        return
    try:
        if field.label == field.LABEL_REPEATED:
            getattr(message, field.name).extend(_items(field, value))
        else:
            setattr(message, field.name, _item(field, value.item() if isinstance(value, np.generic) else value))
    except (TypeError, ValueError) as error:
        raise type(error)(f"{path}: {error}") from None


def _put_messages(message, field, value, path):
    if field.label != field.LABEL_REPEATED:
        _become(getattr(message, field.name), value, path)
        return
    for number, each in enumerate(value):
        _become(getattr(message, field.name).add(), each, f"{path}[{number}]")


def _become(message, value, path):
    message.SetInParent()
    if isinstance(value, dict):
        _filled(message, value, path + ".")
    elif isinstance(value, type(message)):
        message.CopyFrom(value)
    elif message.DESCRIPTOR.name == "Vector" and np.shape(value) == (3,):
        message.x, message.y, message.z = (float(each) for each in value)
    else:
        vector = " or three numbers" if message.DESCRIPTOR.name == "Vector" else ""
        raise TypeError(f"{path}: {value!r} is no {message.DESCRIPTOR.name}, dict of its fields{vector}")


def _items(field, value):
    if field.enum_type is None:
        return np.asarray(value).ravel().tolist()
    return [_item(field, each) for each in ([value] if isinstance(value, (str, int)) else value)]


def _item(field, value):
    return value if field.enum_type is None else number_of(field.enum_type, value)
