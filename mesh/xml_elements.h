#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace antigrasp {

// The attributes of one element.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char* const* pairs) : pairs_(pairs) {}
  // By its name without a namespace, whichever it is of.
  std::optional<std::string_view> Find(std::string_view name) const;

 private:
  const char* const* pairs_;  // name, value, ..., null
};

// XML as a stream of elements, by Expat, which builds no tree: memory does not grow with the text.
// Document types, and with them entities of the file's own, are refused.
class XmlElements {
 public:
  // `uri` begins the namespace that is looked at; others are skipped. `start` and `end` get the
  // name without it and may throw. `text` gets what stands between, piece by piece.
  using Start = std::function<void(std::string_view name, const XmlAttributes& attributes)>;
  using End = std::function<void(std::string_view name)>;
  using Text = std::function<void(std::string_view text)>;
  XmlElements(std::string where, std::string uri, Start start, End end, Text text = nullptr);
  ~XmlElements();
  // The next bytes. InputError that names `where` and the line when they are no XML, and what
  // `start` and `end` throw.
  void Feed(std::string_view bytes);
  void Finish();
  // "part.3mf, 3D/model.model:17", of the element that is being read.
  std::string Where() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace antigrasp
