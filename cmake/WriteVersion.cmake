# Writes OUTPUT from TEMPLATE with VERSION and COMMIT; run at every build, so that the commit is
# the one that was built. OUTPUT changes only when its text does. The commit comes from git in
# SOURCE_DIR, or in an exported tarball from cmake/commit.txt, where git archive puts it.
set(COMMIT "")
if(EXISTS "${SOURCE_DIR}/.git")
  execute_process(
    COMMAND git -C "${SOURCE_DIR}" describe --always --dirty --exclude=* --abbrev=10
    OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
else()
  file(STRINGS "${SOURCE_DIR}/cmake/commit.txt" COMMIT LIMIT_COUNT 1)
endif()
if(NOT COMMIT MATCHES "^[0-9a-f]+(-dirty)?$")
  set(COMMIT unknown)
endif()
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
