// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace myolines::report
{
  // Files of source/report, which the build puts into the program.
  extern const char page_style[];  ///< page.css
  extern const char page_script[]; ///< page.js
  extern const char body_script[]; ///< body.js
} // namespace myolines::report
