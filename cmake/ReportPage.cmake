# The page of `antigrasp report` is made by npm of report/viewer/. ANTIGRASP_HAS_REPORT: whether the command
# is built; antigrasp_report_page(VAR): the rules that make the page, for the directory that calls it.
set(ANTIGRASP_REPORT AUTO CACHE STRING "Build the command report: ON, OFF, AUTO (where npm is found)")
set_property(CACHE ANTIGRASP_REPORT PROPERTY STRINGS AUTO ON OFF)
set(ANTIGRASP_REPORT_TEMPLATE "" CACHE FILEPATH "A template.html made elsewhere, in place of npm")
find_program(ANTIGRASP_NPM npm)

set(ANTIGRASP_HAS_REPORT FALSE)
if(ANTIGRASP_REPORT STREQUAL "AUTO")
  if(ANTIGRASP_NPM OR ANTIGRASP_REPORT_TEMPLATE)
    set(ANTIGRASP_HAS_REPORT TRUE)
  else()
    message(NOTICE "antigrasp report is left out of this build: it needs npm, which was not found")
  endif()
elseif(ANTIGRASP_REPORT)
  if(NOT ANTIGRASP_NPM AND NOT ANTIGRASP_REPORT_TEMPLATE)
    message(FATAL_ERROR "ANTIGRASP_REPORT=ON needs npm, or -DANTIGRASP_REPORT_TEMPLATE=FILE")
  endif()
  set(ANTIGRASP_HAS_REPORT TRUE)
endif()

function(antigrasp_report_page variable)
  if(ANTIGRASP_REPORT_TEMPLATE)
    set(${variable} ${ANTIGRASP_REPORT_TEMPLATE} PARENT_SCOPE)
    return()
  endif()
  set(viewer ${PROJECT_SOURCE_DIR}/report/viewer)
  # npm writes this file last: packages are fetched when the lock file changed, and only then.
  set(packages ${viewer}/node_modules/.package-lock.json)
  add_custom_command(OUTPUT ${packages}
    COMMAND ${ANTIGRASP_NPM} ci --no-audit --no-fund --loglevel=error
    COMMAND ${CMAKE_COMMAND} -E touch ${packages}
    DEPENDS ${viewer}/package.json ${viewer}/package-lock.json
    WORKING_DIRECTORY ${viewer} COMMENT "Fetching the packages of the report's page" VERBATIM)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${viewer}/src/* ${viewer}/scripts/*)
  file(GLOB settings CONFIGURE_DEPENDS ${viewer}/*.html ${viewer}/*.ts ${viewer}/*.json)
  set(page ${viewer}/dist/template.html)
  add_custom_command(OUTPUT ${page}
    COMMAND ${ANTIGRASP_NPM} run --silent build
    COMMAND ${CMAKE_COMMAND} -E touch ${page}
    DEPENDS ${sources} ${settings} ${packages}
    WORKING_DIRECTORY ${viewer} COMMENT "Building the report's page" VERBATIM)
  set(${variable} ${page} PARENT_SCOPE)
endfunction()
