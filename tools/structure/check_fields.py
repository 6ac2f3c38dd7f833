#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that a class whose state is written by a list of fields forgets none of its members.

Such a class has `template <class Self, class Visit> static void fields(Self& self, Visit&& visit)`. Every member is

- visited whole: visit("name", self.member) (or a number), visit("name", *self.member) or Type::fields(self.member, visit)
- declared with a comment behind it that says `no field` or `no fields`
- named by a comment `No fields, REASON: member, member.` of the class

A member that is visited and excused, and a name that is no member, are errors, too.

    check_fields.py [--map]        --map prints what every class visits and leaves out
    check_fields.py --test         tries the check itself
"""
import os, re, sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
COMMENT = re.compile(r"//[^\n]*")
CLASS = re.compile(r"\b(?:class|struct)\s+(\w+)\s*(?:final\s*)?(?::[^;{]*)?\{")
FIELDS = re.compile(r"static void fields\(Self& self, Visit&& visit\) \{")
NO_MEMBER = re.compile(r"(?:using|friend|static|typedef|template|enum|struct|class|virtual|explicit)\b")
EXCUSE = re.compile(r"\bNo fields?, ([^:]*): ([\w, ]+)\.")


def blank(text, spans):
    """`text` with blanks in the place of `spans`; line ends stay."""
    for begin, end in spans:
        text = text[:begin] + re.sub(r"[^\n]", " ", text[begin:end]) + text[end:]
    return text


def closing(code, opening):
    """The place behind the bracket that closes the one at `opening`."""
    depth = 0
    for at in range(opening, len(code)):
        depth += (code[at] in "{(") - (code[at] in "})")
        if depth == 0: return at + 1
    raise ValueError("a bracket is not closed")


def without_brackets(text):
    """Without what is in angle, round and curly brackets."""
    kept, depth = "", 0
    for c in text:
        depth -= c in ">)}"
        if depth == 0: kept += c
        depth += c in "<({"
    return kept


def names_of(declaration):
    """The members that a statement of a class declares."""
    text = re.sub(r"^\s*(?:(?:public|private|protected)\s*:\s*)+", "", declaration).strip()
    if not text or NO_MEMBER.match(text): return []
    flat = re.sub(r"=[^,]*", "", without_brackets(text))
    if "(" in flat or "operator" in flat: return []
    return [re.findall(r"\w+", part.replace("{}", ""))[-1] for part in flat.split(",")]


def statements(code, begin, end):
    """Begin and end of the statements of a class body; bodies of functions and of nested types are passed over."""
    at = start = begin
    while at < end:
        if code[at] == "(":
            at = closing(code, at)
        elif code[at] == "{":
            text = re.sub(r"^\s*(?:(?:public|private|protected)\s*:\s*)+", "", code[start:at]).strip()
            at = closing(code, at)
            if "(" in re.sub(r"=.*", "", without_brackets(text), flags=re.S): start = at
        elif code[at] == ";":
            yield start, at
            at = start = at + 1
        else:
            at += 1


class Source:
    def __init__(self, path, text):
        self.path, self.text = path, text
        strings = [m.span() for m in re.finditer(r'"(?:[^"\\\n]|\\.)*"', text) if "//" in m[0] or "{" in m[0] or "}" in m[0]]
        self.code = blank(text, strings + [m.span() for m in COMMENT.finditer(blank(text, strings))])
        self.classes = [(m[1], m.end(), closing(self.code, m.end() - 1) - 1) for m in CLASS.finditer(self.code)]

    def inner(self, begin, end):
        return [(b, e) for _, b, e in self.classes if begin < b and e < end]

    def comments(self, begin, end):
        """The comment blocks of a class, each in one line, without those of its nested classes."""
        own = blank(self.text[begin:end], [(b - begin, e - begin) for b, e in self.inner(begin, end)])
        return " \n".join(" ".join(re.sub(r"^\s*///?<?", "", line) for line in block.splitlines())
                          for block in re.findall(r"(?:^[ ]*//[^\n]*\n)+", own, re.M))

    def excuses(self, begin, end):
        found = EXCUSE.findall(re.sub(r"[ ]+", " ", self.comments(begin, end)))
        return {name: reason for reason, names in found for name in re.findall(r"\w+", names)}

    def members(self, begin, end):
        """Name of every member, and whether its declaration says that it is no field."""
        own = blank(self.code, [(b - 1, e + 1) for b, e in self.inner(begin, end)])
        found = {}
        for b, e in statements(own, begin, end):
            rest = self.text[e:self.text.index("\n", e)]
            said = re.search(r"//.*\bno fields?\b", self.text[b + len(own[b:e]) - len(own[b:e].lstrip()):e] + rest)
            for name in names_of(own[b:e]): found[name] = bool(said)
        return found

    def lists(self):
        """Class, begin, end and the text of its list of fields."""
        for m in FIELDS.finditer(self.code):
            name, begin, end = max((c for c in self.classes if c[1] < m.start() < c[2]), key=lambda c: c[1])
            yield name, begin, end, self.text[m.end():closing(self.code, m.end() - 1)]


def sources_of(groups):
    """Those of the product that have a list of fields."""
    found = []
    for group in groups:
        for folder, _, files in os.walk(os.path.join(ROOT, group)):
            if "node_modules" in folder or os.path.basename(folder) == "test": continue
            for name in sorted(files):
                if not name.endswith((".hpp", ".cpp")): continue
                path = os.path.join(folder, name)
                with open(path, encoding="utf-8") as f: text = f.read()
                if "static void fields(Self&" in text: found.append(Source(os.path.relpath(path, ROOT), text))
    if not found: raise FileNotFoundError("no source with a list of fields")
    return found


def visited_in(body):
    return set(re.findall(r'(?:visit\((?:"\w+"|\d+u),\s*\*?|::fields\()self\.(\w+)[),]', body))


def judge(place, members, visited, excused):
    errors = [f"{place}: {name} is no field, and no comment says why" for name in members
              if name not in visited and not members[name] and name not in excused]
    errors += [f"{place}: {name} is a field, and a comment says that it is none" for name in members
               if name in visited and (members[name] or name in excused)]
    return errors + [f"{place}: {name} is no member" for name in [*visited, *excused] if name not in members]


def check(sources, show=False):
    errors = []
    for source in sources:
        for name, begin, end, body in source.lists():
            members = source.members(begin, end)
            visited = visited_in(body)
            place = f"{source.path}:{source.text[:begin].count(chr(10)) + 1}: {name}"
            errors += judge(place, members, visited, source.excuses(begin, end))
            if show: print(f"{place}: {len(visited)} of {len(members)} members; not {', '.join(n for n in members if n not in visited) or 'one left out'}")
    return errors


EXAMPLE = """
class Valve final : public Part {
 public:
  explicit Valve(const Settings& settings = {}) : settings_(settings) {}
  double flow() const { return open_ ? flow_ : 0; }
  struct Place {
    double x = 0, y{};
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("x", self.x), visit("y", self.y);
    }
  };
  /// No fields, configure() sets them: settings_,
  /// name_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("open", self.open_), visit("flow", self.flow_);
    if (self.place_) visit("place", *self.place_);
  }

 private:
  static constexpr int most = 3;
  enum class Kind { one, two };
  void step(double dt);
  Settings settings_;
  std::string name_{"a"};
  bool open_ = false, waits_ = f(1, 2);  // no field: it is at rest
  double flow_ = 0;
  std::map<int, std::optional<Place>> by_number_;
  std::optional<Place> place_;
};
"""


def test():
    found = check([Source("valve.hpp", EXAMPLE)])
    wanted = ["open_ is a field, and a comment says", "by_number_ is no field, and no comment"]
    assert len(found) == 2 and all(any(w in f for f in found) for w in wanted), found
    good = EXAMPLE.replace("bool open_ = false, waits_", "bool open_ = false;\n  bool waits_").replace("by_number_;", "by_number_;  // no field")
    assert check([Source("valve.hpp", good)]) == [], check([Source("valve.hpp", good)])
    for new, name in (("double lift_ = 0;", "lift_"), ("std::array<double, 3> a{}, lift_{};  // no field", None), ("const int* lift_ = nullptr;", "lift_")):
        found = check([Source("valve.hpp", good.replace("double flow_ = 0;", "double flow_ = 0;\n  " + new))])
        assert [name] == [f.split()[2] for f in found] if name else found == [], (new, found)
    assert "gone_ is no member" in check([Source("valve.hpp", good.replace("/// name_.", "/// name_, gone_."))])[0]
    assert "y is no field" in check([Source("valve.hpp", good.replace(', visit("y", self.y)', ""))])[0]
    assert "flow_ is no field" in check([Source("valve.hpp", good.replace("self.flow_)", "self.flow_.whole())"))])[0]


if __name__ == "__main__":
    test()
    if "--test" in sys.argv: sys.exit(0)
    errors = check(sources_of(("libs", "services", "gateway", "deploy")), "--map" in sys.argv)
    print("\n".join(errors), file=sys.stderr, end="\n" if errors else "")
    sys.exit(1 if errors else 0)
