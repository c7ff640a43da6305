#pragma once

#include <string>
#include <string_view>

#include "antigrasp/report/page/payload.h"

namespace antigrasp {

// The page: the template with its three markers filled in. CHECKs that each is there once.
std::string FillTemplate(std::string_view page_template, const std::string& title,
                         const ReportPayload& payload);

}  // namespace antigrasp
