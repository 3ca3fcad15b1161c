# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -Doutput= -Dfirst= -Dcompiler= -Dlibraries= -P write_version.cmake: writes the source of version_text(), if it changes.
# The commit comes from git, else from commit.txt, into which `git archive` writes it.
execute_process(COMMAND git describe --always --abbrev=12 --dirty=\ and\ changes --exclude=* OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/commit.txt commit LIMIT_COUNT 1)
  if(commit MATCHES "Format")
    set(commit "unknown")
  endif()
endif()
file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
#include "common/program/version.hpp"

std::string tisserand::version_text() {
  return "@first@\n"
         "commit     @commit@\n"
         "compiler   @compiler@\n"
         "libraries  @libraries@";
}
]])
