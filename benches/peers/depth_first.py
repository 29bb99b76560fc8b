"""Puts the links of a spec that `bgdyn import` wrote in depth-first order: Pinocchio's mass matrix needs that order.

    depth_first.py SPEC
"""

import re
import sys
from pathlib import Path


def reordered(text):
    head, links, tail = re.fullmatch(r"(.*^links:\n)((?:[ #].*\n)*)(.*)", text, re.DOTALL | re.MULTILINE).groups()
    blocks = re.split(r"^(?=  - )", links, flags=re.MULTILINE)[1:]
    named = {re.search(r"\bname: (\w+)", block)[1]: block for block in blocks}
    children = {}
    for name, block in named.items():
        parent = re.search(r"^    parent: (\w+)", block, re.MULTILINE)
        children.setdefault(parent and parent[1], []).append(name)

    def below(name):
        return [name, *(link for child in children.get(name, []) for link in below(child))]

    order = [link for root in children[None] for link in below(root)]
    assert len(blocks) == len(named) and sorted(order) == sorted(named), "a link is lost"
    return head + "".join(named[name] for name in order) + tail


if __name__ == "__main__":
    spec = Path(sys.argv[1])
    spec.write_text(reordered(spec.read_text()))
