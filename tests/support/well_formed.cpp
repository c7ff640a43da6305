#include "tests/support/well_formed.h"

#include <cctype>
#include <set>
#include <vector>

namespace antigrasp::shapes {
namespace {

class Document {
 public:
  explicit Document(const std::string& xml) : xml_(xml) {}

  std::string Check() {
    for (const char c : xml_) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x20 && c != '\n' && c != '\t' && c != '\r') return "a control character";
    }
    if (xml_.starts_with("<?xml") && !Skip("?>")) return "an open declaration";
    while (at_ < xml_.size()) {
      const std::string why = xml_[at_] == '<' ? Tag() : Text();
      if (!why.empty()) return why + " at byte " + std::to_string(at_);
    }
    if (!open_.empty()) return "an open element " + open_.back();
    return roots_ == 1 ? "" : std::to_string(roots_) + " root elements";
  }

 private:
  bool Skip(const std::string& end) {
    const std::size_t found = xml_.find(end, at_);
    if (found == std::string::npos) return false;
    at_ = found + end.size();
    return true;
  }

  // Up to `stop`: no < and no & that begins no entity.
  std::string Characters(char stop) {
    for (; at_ < xml_.size() && xml_[at_] != stop; ++at_) {
      if (xml_[at_] == '<') return "a bare <";
      if (xml_[at_] != '&') continue;
      const std::size_t end = xml_.find(';', at_);
      if (end == std::string::npos || end - at_ > 10) return "a bare &";
    }
    return "";
  }

  std::string Text() {
    const std::size_t first = at_;
    const std::string why = Characters('<');
    const bool blank =
        xml_.substr(first, at_ - first).find_first_not_of(" \n\t\r") == std::string::npos;
    return !why.empty() ? why : blank || !open_.empty() ? "" : "text outside the root";
  }

  std::string Name() {
    const std::size_t first = at_;
    while (at_ < xml_.size() && (std::isalnum(static_cast<unsigned char>(xml_[at_])) ||
                                 std::string("-_:.").find(xml_[at_]) != std::string::npos)) {
      ++at_;
    }
    return xml_.substr(first, at_ - first);
  }

  void Blanks() {
    while (at_ < xml_.size() && std::isspace(static_cast<unsigned char>(xml_[at_]))) ++at_;
  }

  bool Take(const std::string& token) {
    if (xml_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }

  std::string Tag() {
    if (Take("<!--")) return Skip("-->") ? "" : "an open comment";
    if (Take("</")) {
      const std::string name = Name();
      if (open_.empty() || open_.back() != name) return "a closing tag too many: " + name;
      open_.pop_back();
      Blanks();
      return Take(">") ? "" : "a bad closing tag";
    }
    ++at_;
    const std::string name = Name();
    if (name.empty()) return "a tag without a name";
    if (open_.empty()) ++roots_;
    std::set<std::string> attributes;
    while (true) {
      Blanks();
      if (Take("/>")) return "";
      if (Take(">")) {
        open_.push_back(name);
        return "";
      }
      if (!attributes.insert(Name()).second) return "an attribute twice in " + name;
      if (!Take("=\"")) return "an attribute without a value in " + name;
      const std::string why = Characters('"');
      if (!why.empty()) return why;
      if (!Take("\"")) return "an open attribute in " + name;
    }
  }

  const std::string& xml_;
  std::size_t at_ = 0;
  int roots_ = 0;
  std::vector<std::string> open_;
};

}  // namespace

std::string WhyNotWellFormed(const std::string& xml) { return Document(xml).Check(); }

}  // namespace antigrasp::shapes
