#include "antigrasp/report/page/report_template.h"

#include <cstddef>

// The assembler reads the file: a megabyte as a C++ literal costs the compiler seconds and is
// longer than compilers need to accept.
__asm__(
    ".pushsection .rodata\n"
    ".global antigrasp_report_template\n"
    ".global antigrasp_report_template_end\n"
    "antigrasp_report_template:\n"
    ".incbin \"" ANTIGRASP_TEMPLATE_FILE
    "\"\n"
    "antigrasp_report_template_end:\n"
    ".byte 0\n"
    ".popsection\n");
extern "C" const char antigrasp_report_template[];
extern "C" const char antigrasp_report_template_end[];

namespace antigrasp {

std::string_view ReportTemplate() {
  return {antigrasp_report_template,
          static_cast<std::size_t>(antigrasp_report_template_end - antigrasp_report_template)};
}

}  // namespace antigrasp
