// SPDX-License-Identifier: MIT
// The page's template, style and scripts: the files beside this one, put here by cmake/Embed.cmake. ASCII
// only.
#pragma once

namespace conelight::program::embedded {

extern const char* const report_html;
extern const char* const report_css;
extern const char* const pixels_js;
extern const char* const tables_js;
extern const char* const report_js;

}  // namespace conelight::program::embedded
