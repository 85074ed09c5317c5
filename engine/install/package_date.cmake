# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT

# Read by cpack: files in packages bear the date of the version, not that of the build.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  set(ENV{SOURCE_DATE_EPOCH} 1767225600)  # 2026-01-01
endif()
