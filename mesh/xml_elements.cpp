#include "antigrasp/mesh/xml_elements.h"

#include <expat.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr char kSeparator = '|';                           // between a namespace and a name
constexpr std::size_t kMostAtOnce = std::size_t{1} << 24;  // Expat counts in int

std::string_view LocalName(std::string_view name) {
  return name.substr(name.rfind(kSeparator) + 1);  // npos + 1 = 0
}

}  // namespace

std::optional<std::string_view> XmlAttributes::Find(std::string_view name) const {
  for (const char* const* pair = pairs_; *pair != nullptr; pair += 2) {
    if (LocalName(pair[0]) == name) return pair[1];
  }
  return std::nullopt;
}

// Nothing may be thrown through Expat, which is C: it is stopped, and Feed() throws.
struct XmlElements::State {
  std::string where, uri;
  Start start;
  End end;
  Text text;
  XML_Parser parser = nullptr;
  std::exception_ptr thrown;

  template <typename Call>
  void Guarded(const char* name, const Call& call) {
    if (thrown || !std::string_view(name).starts_with(uri)) return;
    try {
      call(LocalName(name));
    } catch (...) {
      thrown = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }

  static void OnStart(void* state, const char* name, const char** attributes) {
    auto* self = static_cast<State*>(state);
    self->Guarded(name,
                  [&](std::string_view local) { self->start(local, XmlAttributes(attributes)); });
  }
  static void OnEnd(void* state, const char* name) {
    auto* self = static_cast<State*>(state);
    self->Guarded(name, self->end);
  }
  static void OnText(void* state, const char* text, int length) {
    auto* self = static_cast<State*>(state);
    self->Guarded(self->uri.c_str(), [&](std::string_view) {
      self->text({text, static_cast<std::size_t>(length)});
    });
  }
  static void OnDocumentType(void* state, const char*, const char*, const char*, int) {
    auto* self = static_cast<State*>(state);
    self->Guarded(self->uri.c_str(), [&](std::string_view) {
      throw InputError("a document type", self->where, "XML without one");
    });
  }
};

XmlElements::XmlElements(std::string where, std::string uri, Start start, End end, Text text)
    : state_(std::make_unique<State>()) {
  state_->where = std::move(where);
  state_->uri = std::move(uri);
  state_->start = std::move(start);
  state_->end = std::move(end);
  state_->text = std::move(text);
  state_->parser = XML_ParserCreateNS(nullptr, kSeparator);
  XML_SetUserData(state_->parser, state_.get());
  XML_SetElementHandler(state_->parser, &State::OnStart, &State::OnEnd);
  if (state_->text) XML_SetCharacterDataHandler(state_->parser, &State::OnText);
  XML_SetStartDoctypeDeclHandler(state_->parser, &State::OnDocumentType);
}

XmlElements::~XmlElements() { XML_ParserFree(state_->parser); }

std::string XmlElements::Where() const {
  return state_->where + ":" + std::to_string(XML_GetCurrentLineNumber(state_->parser));
}

void XmlElements::Feed(std::string_view bytes) {
  do {
    const std::string_view now = bytes.substr(0, std::min(bytes.size(), kMostAtOnce));
    bytes.remove_prefix(now.size());
    const bool parsed = XML_Parse(state_->parser, now.data(), static_cast<int>(now.size()),
                                  XML_FALSE) == XML_STATUS_OK;
    if (state_->thrown) std::rethrow_exception(state_->thrown);
    if (!parsed) {
      throw InputError(
          std::string("damaged XML: ") + XML_ErrorString(XML_GetErrorCode(state_->parser)), Where(),
          "well-formed XML");
    }
  } while (!bytes.empty());
}

void XmlElements::Finish() {
  if (XML_Parse(state_->parser, "", 0, XML_TRUE) == XML_STATUS_OK) return;
  throw InputError("XML ends early", Where(), "well-formed XML");
}

}  // namespace antigrasp
