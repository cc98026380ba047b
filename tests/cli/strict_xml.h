// A strict look at XML: what a browser would forgive is an error here.
#pragma once

#include <string>

namespace pullfocus::test {

// Empty if `text` is well-formed (one root, tags closed in order, quoted attributes each once, known entities, no stray
// < or &), or else what is wrong. A DOCTYPE may come first; comments, CDATA and processing instructions are not known.
std::string xml_problem(const std::string& text);

}  // namespace pullfocus::test
