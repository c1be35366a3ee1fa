#!/usr/bin/env python3
"""Holds the documentation against the sources that cite it.

Every docs/...md named in src, apps, the README or the other pages exists; every "docs/physics/<page>.md, Eq. (n)" of the sources has a numbered
equation, a line indented by four spaces that ends in (n), on that page, and no page has two of one number; every relative link in docs and the
README leads somewhere; every source file that a page names in `room/file.h` form exists, and every `Class::member`, but those of decisions, which
may tell of what is gone; every page of docs/results that says by which line it was made says the line by which `make results` would make it, and
every picture beside it is on it.
"""
import re
import sys

from told_faults import tell

PAGE = re.compile(r"\bdocs/[\w./-]+?\.md\b")
NUMBERS = r"(Eqs?\.(?:\s*(?:\(\w+\)|,|–|-|and|to))+)"
# The page, or, for a number that stands alone at the end of a formula's line, the page cited last.
CITATION = re.compile(r"(?:\b(docs/physics/\w+\.md),?\s+|(?<=[^\s,]  )[ ]*)" + NUMBERS)
LINK = re.compile(r"(?<!!)\[[^\]]*\]\(([^)\s]+)\)|!\[[^\]]*\]\(([^)\s]+)\)")
MEMBER = re.compile(r"`((?:\w+::)+\w+)`")
SOURCE = re.compile(r"`((?:\w+/)+\w+\.(?:h|cpp|py))`")
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


def cited_numbers(words):
    """The equations of "Eqs. (1), (3)–(5)": 1, 3, 4, 5."""
    numbers = []
    for number, joint in re.findall(r"\((\w+)\)\s*(–|-|to)?", words):
        if numbers and numbers[-1] is None:
            numbers.pop()
            numbers += [str(n) for n in range(int(numbers[-1]) + 1, int(number) + 1)]
        else:
            numbers.append(number)
        if joint:
            numbers.append(None)
    return numbers


def numbered_equations(page):
    """The number of each equation, and the line where it stands."""
    for line, text in enumerate(page.read_text().splitlines(), 1):
        equation = re.match(r" {4}.*\S\s+\((\w+)\)$", text)
        if equation:
            yield equation.group(1), line


def without_comment_marks(text):
    """Comments as running text of the same length, so that a citation may go over the end of a line."""
    return re.sub(r"\n[ \t]*(?:///?<?|#)", lambda mark: "\n" + " " * (len(mark.group()) - 1), text)


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def source_files(root):
    for folder in ("src", "apps"):
        yield from sorted(p for p in (root / folder).rglob("*") if p.suffix in {".h", ".cpp", ".txt"})


def pages(root):
    yield from sorted((root / "docs").rglob("*.md"))
    yield from sorted(root.glob("README*"))


def missing_pages(root):
    for path in [*source_files(root), *pages(root)]:
        text = path.read_text()
        for named in PAGE.finditer(text):
            if not (root / named.group()).is_file():
                yield f"{path.relative_to(root)}:{line_of(text, named.start())}: {named.group()} does not exist"


def missing_equations(root):
    citations = 0
    for path in source_files(root):
        text = without_comment_marks(path.read_text())
        name = None
        for cited in CITATION.finditer(text):
            name = cited.group(1) or name
            if name is None or not (root / name).is_file():
                continue
            page = root / name
            there = {number for number, _ in numbered_equations(page)}
            for number in cited_numbers(cited.group(2)):
                citations += 1
                if number not in there:
                    yield f"{path.relative_to(root)}:{line_of(text, cited.start())}: {name} has no Eq. ({number})"
    if citations == 0:
        yield "no citation of a numbered equation was found in the sources"


def equations_of_one_number(root):
    for page in sorted((root / "docs" / "physics").glob("*.md")):
        first = {}
        for number, line in numbered_equations(page):
            if first.setdefault(number, line) != line:
                yield f"{page.relative_to(root)}:{line}: Eq. ({number}) is on line {first[number]} already"


def missing_members(root):
    words = {word for path in source_files(root) for word in re.findall(r"\w+", path.read_text())}
    for path in pages(root):
        if path.parent.name == "decisions":
            continue
        text = path.read_text()
        for named in MEMBER.finditer(text):
            gone = [word for word in named.group(1).split("::") if word not in words]
            if gone:
                yield f"{path.relative_to(root)}:{line_of(text, named.start())}: {named.group(1)}: no source has {gone[0]}"


def missing_sources(root):
    for path in sorted((root / "docs").rglob("*.md")):
        text = path.read_text()
        for named in SOURCE.finditer(text):
            if not any((base / named.group(1)).is_file() for base in (root, root / "src" / "sigmascape")):
                yield f"{path.relative_to(root)}:{line_of(text, named.start())}: there is no {named.group(1)}"


def broken_links(root):
    for path in pages(root):
        text = FENCE.sub(lambda block: "\n" * block.group().count("\n"), path.read_text())
        for link in LINK.finditer(text):
            target = (link.group(1) or link.group(2)).split("#")[0]
            if not target or re.match(r"[a-z]+:", target):
                continue
            if not (path.parent / target).exists():
                yield f"{path.relative_to(root)}:{line_of(text, link.start())}: the link to {target} leads nowhere"


def options_of(line):
    """What a line of `sigmascape results` asks for, apart from where files go, of which a page says only what is no matter of the machine."""
    options = re.findall(r"(--\S+)((?: (?!--)\S+)*)", line)
    return {name: values.split("/")[-1] for name, values in options if name not in ("--out", "--page")}


def pages_of_other_lines(root):
    makefile = (root / "Makefile").read_text()
    variables = dict(re.findall(r"^(\w+) \?= (.*)$", makefile, re.MULTILINE))
    recipes = re.findall(r"^\t\$\(measure\) (.* --page (docs/results/\S+))$", makefile, re.MULTILINE)
    if not recipes:
        yield "Makefile: no line writes a page of docs/results"
    for recipe, page in recipes:
        made_by = re.search(r"^sigmascape results .*$", (root / page).read_text(), re.MULTILINE)
        wanted = options_of(re.sub(r"\$\((\w+)\)", lambda name: variables.get(name.group(1), ""), recipe))
        if made_by and options_of(made_by.group()) != wanted:
            yield f"{page}: was made by another line than `make results` has for it"


def pictures_on_no_page(root):
    """What a page made anew under other names leaves lying."""
    for page in sorted((root / "docs" / "results").rglob("README.md")):
        shown = {target for link in LINK.findall(page.read_text()) for target in link}
        for picture in sorted(page.parent.glob("*")):
            if picture.suffix in {".png", ".svg"} and picture.name not in shown:
                yield f"{picture.relative_to(root)}: the page beside it does not show it"


def faults(root):
    checks = (missing_pages, missing_equations, equations_of_one_number, missing_members, missing_sources, broken_links, pages_of_other_lines,
              pictures_on_no_page)
    for check in checks:
        yield from check(root)


if __name__ == "__main__":
    sys.exit(tell("documentation", faults))
