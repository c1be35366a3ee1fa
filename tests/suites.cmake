# Read by CTest, once for each test program: every suite is one test, so that what a suite sets up is set up once.
# `program`, `prefix` and `properties` are set by who includes it.
if(NOT EXISTS "${program}")
  add_test("${prefix}.has_not_been_built" "${program}")
  return()
endif()
execute_process(COMMAND "${program}" --gtest_list_tests
                OUTPUT_VARIABLE listed TIMEOUT 60 COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "," listed "${listed}")
string(REPLACE "\n" ";" listed "${listed}")
foreach(line IN LISTS listed)
  if(line MATCHES "^([^ ]+)\\.( |$)")
    set(suite "${CMAKE_MATCH_1}")
    add_test("${prefix}.${suite}" "${program}" "--gtest_filter=${suite}.*")
    set_tests_properties("${prefix}.${suite}" PROPERTIES ${properties})
  endif()
endforeach()
