# SPDX-License-Identifier: Apache-2.0
"""Pages of the C++ and C API: what Doxygen read from the headers, a page for each room; and which names have no text.

Doxygen's XML is read once; nothing here has words of its own.
"""
from __future__ import annotations

import pathlib
import re
import xml.etree.ElementTree as ET
from collections import defaultdict

SPECIAL = re.compile(r"([\\*_`\[\]<>|])")


def escaped(text: str) -> str:
    return SPECIAL.sub(r"\\\1", re.sub(r"\s+", " ", text))


def plain(node: ET.Element | None) -> str:
    return "" if node is None else re.sub(r"\s+", " ", "".join(node.itertext())).strip()


def prose(node: ET.Element | None) -> str:
    """A description as Markdown; paragraphs between empty lines."""
    if node is None:
        return ""
    return re.sub(r"\n{3,}", "\n\n", _children(node)).strip()


def _children(node: ET.Element) -> str:
    text = escaped(node.text or "")
    for child in node:
        text += _element(child) + escaped(child.tail or "")
    return text


def _element(node: ET.Element) -> str:
    tag = node.tag
    if tag == "para":
        return _children(node).strip() + "\n\n"
    if tag == "computeroutput":
        return "`" + plain(node).replace("`", "'") + "`"
    if tag in ("programlisting", "verbatim", "preformatted"):
        lines = [plain(line) for line in node.iter("codeline")] or "".join(node.itertext()).split("\n")
        return "\n\n```text\n" + "\n".join(lines) + "\n```\n\n"
    if tag in ("itemizedlist", "orderedlist"):
        return "\n\n" + "".join("- " + _children(i).strip().replace("\n\n", " ") + "\n" for i in node) + "\n"
    if tag == "parameterlist":
        title = {"param": "", "exception": "throws ", "templateparam": "", "retval": "returns "}[node.get("kind")]
        rows = []
        for item in node.iter("parameteritem"):
            names = ", ".join(plain(n) for n in item.iter("parametername"))
            rows.append(f"- {title}`{names}`: {prose(item.find('parameterdescription'))}".replace("\n\n", " "))
        return "\n\n" + "\n".join(rows) + "\n\n"
    if tag == "simplesect":
        kind = {"return": "Returns", "note": "Note", "see": "See", "warning": "Warning"}.get(node.get("kind"), "")
        return f"\n\n{kind}: {_children(node).strip()}\n\n"
    if tag in ("ndash", "mdash"):
        return "-"
    if tag == "sp":
        return " "
    if tag == "linebreak":
        return "\n"
    return _children(node)


class Entity:
    """A function, class, enumeration, alias or variable."""

    def __init__(self, node: ET.Element, owner: str = ""):
        self.node, self.owner = node, owner
        self.kind = node.get("kind", "")
        self.name = plain(node.find("name")) or plain(node.find("compoundname"))
        self.text = prose(node.find("briefdescription")) + "\n\n" + prose(node.find("detaileddescription"))
        self.text = self.text.strip()
        location = node.find("location")
        self.file = "" if location is None else location.get("file", "")
        self.line = 0 if location is None else int(location.get("line", 0))

    def signature(self) -> str:
        definition, arguments = plain(self.node.find("definition")), plain(self.node.find("argsstring"))
        definition = re.sub(r"\bsublimit::(testing::)?", "", definition)
        if self.owner:  # members are named by their class above
            for owner in (re.sub(r"^sublimit::", "", self.owner), self.owner.split("::")[-1].split("<")[0].strip()):
                definition = definition.replace(owner + "::", "")
        return (definition + arguments).replace("`", "'")

    def must_have_text(self) -> bool:
        """A function that its name alone does not explain: no constructor, operator, override or default."""
        if self.kind != "function" or self.node.get("prot") != "public":
            return False
        arguments = plain(self.node.find("argsstring"))
        own = self.owner.split("::")[-1].split("<")[0].strip()
        return not (self.name.startswith(("operator", "~")) or self.name == own or "=delete" in arguments.replace(" ", "")
                    or "=default" in arguments.replace(" ", "") or self.node.find("reimplements") is not None)


def idea(header: pathlib.Path) -> str:
    """The comment that a header begins with."""
    lines = []
    for line in header.read_text().split("\n"):
        if line.startswith("// ") and not line.startswith("// SPDX"):
            lines.append(line[3:])
        elif line == "//" and lines:
            lines.append("")
        elif line.startswith(("#include", "namespace", "#ifdef", "extern")) and not lines:
            break
        elif lines:
            break
    return "\n\n".join(escaped(part.replace("\n", " ")) for part in "\n".join(lines).split("\n\n"))


def read(xml: pathlib.Path, root: pathlib.Path) -> dict[str, list[Entity]]:
    """Entities by header, from the root of the sources, in the order of the header."""
    found: dict[str, list[Entity]] = defaultdict(list)
    for path in sorted(xml.glob("*.xml")):
        if not path.name.startswith(("class", "struct", "union", "namespace")):
            continue
        for compound in ET.parse(path).getroot().iter("compounddef"):
            is_class = compound.get("kind") in ("class", "struct", "union")
            name = plain(compound.find("compoundname"))
            if is_class:
                entity = Entity(compound)
                entity.members = [Entity(m, name) for m in compound.iter("memberdef") if m.get("prot") == "public"]
                found[entity.file].append(entity)
                continue
            for member in compound.iter("memberdef"):
                entity = Entity(member)
                entity.members = []
                found[entity.file].append(entity)
    by_header = {}
    for file, entities in found.items():
        path = pathlib.Path(file)
        if path.is_absolute() and path.is_relative_to(root):
            by_header[str(path.relative_to(root))] = sorted(entities, key=lambda e: (e.line, e.name))
    return by_header


def room_of(header: str) -> str:
    """The folder of a header, without the detail/ of what is not public."""
    folder = pathlib.Path(header).parent
    return str(folder.parent if folder.name == "detail" else folder)


def undocumented(by_header: dict[str, list[Entity]]) -> dict[str, list[str]]:
    """Functions without a text, by room."""
    missing: dict[str, list[str]] = defaultdict(list)
    for header, entities in by_header.items():
        for entity in entities:
            for one in [entity, *entity.members]:
                if one.must_have_text() and not one.text:
                    missing[room_of(header)].append(f"{header}:{one.line}: {one.name}")
    return {room: sorted(set(names)) for room, names in missing.items()}


def section(header: str, entities: list[Entity], root: pathlib.Path) -> str:
    include = header.split("/", 1)[1]
    text = f"## `<{include}>`\n\n{idea(root / header)}\n\n"
    for entity in entities:
        if entity.kind in ("class", "struct", "union"):
            name = re.sub(r"^sublimit::", "", entity.name)
            text += f"### `{entity.kind} {name}`\n\n{entity.text}\n\n"
            rows = [m for m in entity.members if m.kind in ("function", "variable", "enum", "typedef")]
            for member in rows:
                shown = member.signature() or f"enum {member.name}"
                text += f"- `{shown}`" + (": " + member.text.replace("\n\n", " ").replace("\n", " ") if member.text else "") + "\n"
            text += "\n"
        elif entity.kind in ("function", "enum", "typedef", "variable") and not entity.name.startswith("@"):
            text += f"```cpp\n{entity.signature() or 'enum class ' + entity.name}\n```\n\n{entity.text}\n\n"
    return text


def write(xml: pathlib.Path, root: pathlib.Path, out: pathlib.Path) -> tuple[list[str], dict[str, list[str]]]:
    """Writes the pages; returns their names, in order, and what has no text."""
    by_header = read(xml, root)
    rooms: dict[str, list[str]] = defaultdict(list)
    for header in sorted(by_header):
        if "/detail/" not in header:
            rooms[room_of(header)].append(header)
    names = []
    out.mkdir(parents=True, exist_ok=True)
    for room, headers in sorted(rooms.items()):
        name = room.replace("/sublimit", "").replace("/", "-")
        readme = root / room / "README.md"
        text = f"# {room.replace('/sublimit', '')}\n\n"
        if readme.exists():
            text += f"The idea of this room: [README](../../{room}/README.md).\n\n"
        text += "".join(section(h, by_header[h], root) for h in headers)
        (out / f"{name}.md").write_text(text)
        names.append(name)
    return names, undocumented(by_header)
