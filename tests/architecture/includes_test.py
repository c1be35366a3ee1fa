#!/usr/bin/env python3
"""Holds that every file of src and apps includes what it takes from the headers that the build precompiles, and none of them else.

The compiler has read those headers before it reads the file and can't tell; who links the library, or builds without precompiled
headers, would be the first to know. What a file includes through headers of the project counts, what standard headers happen to
include of one another does not.
"""
import functools
import re
import sys

from told_faults import tell

# By what names a header is known to be needed. std::size_t, std::move and their like come with nearly any of them.
NAMES = {
    "algorithm": r"std::(ranges::)?(all_of|any_of|none_of|binary_search|clamp|copy(_if|_n)?|count(_if)?|equal|fill(_n)?|find(_if(_not)?)?"
                 r"|for_each|is_sorted|lower_bound|max|max_element|min|min_element|minmax(_element)?|nth_element|partial_sort|partition|remove_if"
                 r"|replace|reverse|rotate|sort|stable_sort|transform|unique|upper_bound)\(",
    "array": r"std::(array<|to_array)",
    "cmath": r"std::(a?cosh?|a?sinh?|a?tanh?|atan2|cbrt|ceil|copysign|erfc?|exp2?|expm1|floor|fma|fmod|hypot|is(finite|inf|nan)|ldexp"
             r"|ll?r(ound|int)|lgamma|log(10|1p|2)?|nearbyint|pow|remainder|rint|round|signbit|sqrt|tgamma|trunc)\(",
    "complex": r"std::(complex<|polar\(|conj\(|arg\()",
    "cstdint": r"std::u?int(8|16|32|64)_t",
    "filesystem": r"std::filesystem",
    "fmt/format.h": r"fmt::(format(_to)?\(|memory_buffer)",
    "fmt/ranges.h": r"fmt::join",
    "functional": r"std::(function<|hash<|greater|less<|plus<|ref\(|invoke\()",
    "limits": r"std::numeric_limits",
    "map": r"std::(multi)?map<",
    "memory": r"std::(make_)?(unique|shared)(_ptr)?<",
    "optional": r"std::(optional<|nullopt)",
    "span": r"std::(span<|as_bytes|as_writable_bytes)",
    "string": r"std::((u8|u16|u32)?string\b(?!_view)|to_string)",
    "string_view": r"std::string_view",
    "vector": r"std::vector<",
}


# What else a header may be included for.
ALSO = {
    "algorithm": r"std::ranges::\w+\(|std::(remove|search|swap_ranges|merge|mismatch|generate(_n)?|iter_swap|next_permutation|is_permutation"
                 r"|inplace_merge|includes|set_\w+|adjacent_find|push_heap|pop_heap|make_heap|sort_heap|shift_left|move_backward)\(",
    "array": r"std::(array\b|tuple_size)",
    "cmath": r"std::(abs|fabs|fmin|fmax|modf|frexp|ilogb|logb|nan|nextafter|fpclassify)\b|INFINITY|\bNAN\b|M_PI",
    "complex": r"std::(norm|abs|imag|real)\(|_i\b",
    "cstdint": r"\bu?int(8|16|32|64|ptr|max)_t\b|std::u?int(ptr|max)_t|SIZE_MAX",
    "functional": r"std::(bit_\w+|equal_to|identity|less|greater|reference_wrapper|minus|multiplies|plus|not_fn|cref)\b",
    "map": r"std::(multi)?map\b",
    "memory": r"std::(allocator|weak_ptr|default_delete|enable_shared|addressof|(static|dynamic)_pointer_cast|assume_aligned|destroy)|std::(unique|shared)_ptr",
    "optional": r"std::(make_)?optional",
    "span": r"std::span",
    "string": r"std::(getline|sto[a-z]+|char_traits|operator\"\"s)|\"\"s\b",
    "vector": r"std::vector|std::erase",
    "fmt/format.h": r"fmt::\w+",
    "fmt/ranges.h": r"fmt::\w+",
}


def without_remarks(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"(\\.|[^\"\\\n])*\"", "", text, flags=re.DOTALL)


@functools.lru_cache(maxsize=None)
def included(path, roots):
    """What a file includes: angle brackets by name, the project's own headers followed."""
    found = set()
    for bracket, name in re.findall(r'^#include ([<"])([^>"]+)[>"]', path.read_text(), re.MULTILINE):
        if bracket == "<":
            found.add(name)
        else:
            inner = next((r / name for r in (path.parent, *roots) if (r / name).is_file()), None)
            found |= included(inner, roots) if inner else set()
    return frozenset(found)


def precompiled(root):
    text = (root / "cmake" / "room.cmake").read_text()
    return set(re.findall(r"<([\w/.]+)>", re.search(r"target_precompile_headers\([^)]*<[^)]*\)", text).group(0)))


def faults(root):
    listed = precompiled(root)
    for header in sorted(listed - set(NAMES)):
        yield f"cmake/room.cmake precompiles <{header}>, and nothing here knows by what names it is needed"
    roots = (root / "src", root / "apps" / "sigmascape")
    for path in sorted(p for r in roots for p in r.rglob("*") if p.suffix in {".h", ".cpp"}):
        code = without_remarks(path.read_text())
        has = included(path, roots)
        for header in sorted(listed & set(NAMES)):
            use = re.search(NAMES[header], code)
            if use and header not in has:
                yield f"{path.relative_to(root)}: {use.group(0)} without #include <{header}>"
            takes = use or re.search(ALSO.get(header, "(?!)"), code)
            if not takes and re.search(rf"^#include <{re.escape(header)}>", path.read_text(), re.MULTILINE):
                yield f"{path.relative_to(root)}: takes nothing of #include <{header}>"


if __name__ == "__main__":
    sys.exit(tell("includes", faults))
