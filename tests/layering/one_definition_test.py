#!/usr/bin/env python3
"""Every type that other files may see has a name of its own: the linker takes the templates of one of two types of one name for both.

usage: one_definition_test.py    check the repository, then the check itself on planted types
"""
import os
import re
import sys
from collections import defaultdict
from pathlib import Path

LEFT_OUT = re.compile(r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
TOKEN = re.compile(r"namespace\s*([\w:]*)\s*\{|\b(?:struct|class|enum\s+class|union)\s+(\w+)\s*(?:final\s*)?(?::(?!:)[^;{()]*)?\{|[{}]")


def types_of(text):
    """Names with their namespaces, "a::b::Name", of the types that a file defines outside of unnamed namespaces, types and functions."""
    scopes, found = [], []
    for match in TOKEN.finditer(LEFT_OUT.sub(" ", text)):
        if match[0] == "}":
            if scopes:
                scopes.pop()
            continue
        if match[2] and all(scope is not None for scope in scopes) and "" not in scopes:
            found.append("::".join([*scopes, match[2]]))
        scopes.append(match[1] if match[0].startswith("namespace") else None)
    return found


def defined_twice(files):
    """files: (name, text). One line for each name of several types."""
    places = defaultdict(list)
    for name, text in files:
        for found in types_of(text):
            places[found].append(name)
    return [f"{found} is defined in {', '.join(where)}" for found, where in sorted(places.items()) if len(where) > 1]


PLANTED = [  # two files, whether the check must speak
    ("namespace a { struct B { int c; }; }", "namespace a { struct B final { int d; }; }", True),
    ("namespace a::b {\nclass C : public D<int> {\n};\n}", "namespace a { namespace b { class C {}; } }", True),
    ("namespace a { struct B {}; }", "namespace a { namespace { struct B {}; } }", False),
    ("namespace a { struct B {}; }", "namespace c { struct B {}; }", False),
    ("namespace a { struct B {}; }", "namespace a { struct C { struct B {}; }; struct B; }", False),
    ("namespace a { struct B {}; }", "namespace a { /* struct B { */ void f() { struct B {}; } const char* s = \"struct B {\"; }", False),
    ("namespace a { class B { class C; }; }", "namespace a { class B::C {}; }", False),
]


def main():
    root = Path(os.environ.get("ROCKFOLD_SOURCE_DIR", Path(__file__).resolve().parents[2]))
    paths = sorted(p for folder in ("src", "host", "kernels") for p in (root / folder).rglob("*.?pp"))
    twice = defined_twice((p.relative_to(root).as_posix(), p.read_text(encoding="utf-8")) for p in paths)
    for line in twice:
        print(line)
    wrong = [case for case in PLANTED if bool(defined_twice([("one", case[0]), ("two", case[1])])) != case[2]]
    for case in wrong:
        print("the check itself:", case)
    print(f"{len(paths)} files, {len(twice)} names of several types; {len(PLANTED)} planted cases, {len(wrong)} answered wrongly")
    return 1 if twice or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
