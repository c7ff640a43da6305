#pragma once

#include <string>

namespace antigrasp::shapes {

// Why the text is no well-formed XML document, "" when it is one: one root element, tags that nest,
// attributes in double quotes and once each, no bare & or < in text and attributes, no control
// characters. Knows elements, attributes, comments and the declaration, which is what a drawing
// has.
std::string WhyNotWellFormed(const std::string& xml);

}  // namespace antigrasp::shapes
