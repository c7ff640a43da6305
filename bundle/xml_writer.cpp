#include "antigrasp/bundle/xml_writer.h"

#include "antigrasp/core/check.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/markup.h"

namespace antigrasp {

std::string NumbersText(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + FormatDouble(value + 0.0);
  return text;
}

std::string NumbersText(const Eigen::Vector3d& v) { return NumbersText({v.x(), v.y(), v.z()}); }

XmlWriter::XmlWriter(std::string_view comment) {
  text_ = "<?xml version=\"1.0\"?>\n<!-- " + std::string(comment) + " -->\n";
}

void XmlWriter::Open(std::string_view element, const Attributes& attributes) {
  text_ += Start(element, attributes) + ">\n";
  open_.emplace_back(element);
}

void XmlWriter::Close() {
  AG_CHECK(!open_.empty(), "an open element");
  const std::string element = open_.back();
  open_.pop_back();
  text_ += std::string(2 * open_.size(), ' ') + "</" + element + ">\n";
}

void XmlWriter::Leaf(std::string_view element, const Attributes& attributes) {
  text_ += Start(element, attributes) + "/>\n";
}

void XmlWriter::Text(std::string_view element, std::string_view text,
                     const Attributes& attributes) {
  text_ +=
      Start(element, attributes) + ">" + MarkupEscaped(text) + "</" + std::string(element) + ">\n";
}

std::string XmlWriter::Take() {
  AG_CHECK(open_.empty(), "every element closed");
  return std::move(text_);
}

std::string XmlWriter::Start(std::string_view element, const Attributes& attributes) const {
  std::string start = std::string(2 * open_.size(), ' ') + "<" + std::string(element);
  for (const auto& [name, value] : attributes) {
    start += " " + std::string(name) + "=\"" + MarkupEscaped(value) + "\"";
  }
  return start;
}

}  // namespace antigrasp
