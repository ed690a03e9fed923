"""What a Redis means when it refuses: its words say what it can't do, not what it is or what to do about it."""

import re

_MEANINGS = (
    (
        r"READONLY|read only replica|MASTERDOWN|Link with MASTER",
        "this Redis is a replica, which takes no writes; name its primary",
    ),
    (
        r"MOVED|CROSSSLOT|CLUSTERDOWN|TRYAGAIN|same slot|Hash slot not served|cluster is down",
        "this Redis is a node of a cluster, which spreads keys over servers; the farm needs a single Redis",
    ),
    (
        r"OOM|used memory > 'maxmemory'",
        "this Redis is full: its memory has reached maxmemory; raise that or free some, then repeat the command",
    ),
    (
        r"MISCONF|unable to persist",
        "this Redis takes no writes, as it can't save to its own disk; free that disk, or see its log",
    ),
    (r"LOADING|loading the dataset in memory", "this Redis still loads its data; repeat the command in a moment"),
    (
        r"NOAUTH|WRONGPASS|Authentication required|invalid (username-)?password|invalid username|without any password"
        r"|wrong number of arguments for 'auth'|client already authenticated",
        "this Redis refuses the user or the password, or lack of them; write redis://USER:PASSWORD@HOST:PORT/NUMBER",
    ),
    (
        r"NOPERM|has no permissions|No permissions to access",
        "this Redis's access list forbids what the farm needs; allow it, as docker/redis-users.acl does",
    ),
    (
        r"protected mode",
        "this Redis is in protected mode and serves its own machine alone; give it a password, and this address too",
    ),
    (r"NOREPLICAS|Not enough good replicas", "this Redis takes no writes while its replicas are away; mend those"),
    (r"DB index is out of range", "this Redis has no database of that number; take a smaller one, such as 0"),
    (r"BUSY\b|busy running a script", "this Redis is busy with a script of somebody; repeat the command later"),
    (
        r"unknown command|Unknown Redis command|non deterministic commands",
        "this server lacks a command that the farm needs; take a Redis of version 5 or newer",
    ),
)
"""Patterns of Redis's words, also as a script or pipeline repeats them, with their meaning; the first match counts."""


def meaning(error: Exception) -> str | None:
    """Tell what a Redis is that refuses, and what to do; None if its words are not known. It is one line."""
    said = f"{type(error).__name__} {error}"
    return next((words for pattern, words in _MEANINGS if re.search(pattern, said)), None)


def explained(error: Exception) -> str:
    """The meaning of a refusal with Redis's own words, else those words alone; one line."""
    own = " ".join(str(error).split()).rstrip(". ")
    known = meaning(error)
    return own if known is None else f"{known} (it says: {own[:120]})"
