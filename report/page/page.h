#pragma once

#include <string>
#include <string_view>

#include "antigrasp/report/page/payload.h"

namespace antigrasp {

// Text as HTML shows it, in an element or a quoted attribute.
std::string HtmlEscape(std::string_view text);

// The page: the template with its three markers filled in. CHECKs that each is there once.
std::string FillTemplate(std::string_view page_template, const std::string& title,
                         const ReportPayload& payload);

}  // namespace antigrasp
