#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace antigrasp {

// "0.5 0 -1", digits enough to read back the same numbers.
std::string NumbersText(std::initializer_list<double> values);
std::string NumbersText(const Eigen::Vector3d& v);

// An XML document line by line, elements indented. Attribute values are escaped.
class XmlWriter {
 public:
  using Attributes = std::vector<std::pair<std::string_view, std::string>>;

  explicit XmlWriter(std::string_view comment);  // the declaration, and a comment without "--"
  void Open(std::string_view element, const Attributes& attributes = {});
  void Close();
  void Leaf(std::string_view element, const Attributes& attributes);
  void Text(std::string_view element, std::string_view text,
            const Attributes& attributes = {});  // <element>text</element>
  std::string Take();                            // every element closed

 private:
  std::string Start(std::string_view element, const Attributes& attributes) const;

  std::string text_;
  std::vector<std::string> open_;
};

}  // namespace antigrasp
