#include <gtest/gtest.h>
#include <iostream>

namespace sigmascape {
namespace {

/// Keeps CTest, which knows suites and not their tests, from taking for a pass what did not run.
class SuiteListener : public testing::EmptyTestEventListener {
  /// GoogleTest calls the tests of a suite whose SetUpTestSuite failed skipped. Here they fail.
  void OnTestStart(const testing::TestInfo& /*test*/) override {
    if (testing::UnitTest::GetInstance()->current_test_suite()->ad_hoc_test_result().Failed())
      ADD_FAILURE() << "not run, since SetUpTestSuite failed";
  }

  /// What tests/CMakeLists.txt has CTest look for. One that failed counts for more than one that was skipped.
  void OnTestProgramEnd(const testing::UnitTest& tests) override {
    if (tests.skipped_test_count() > 0 && tests.Passed()) std::cout << "Passed, but for tests that were skipped\n";
  }
};

[[maybe_unused]] const bool listening = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new SuiteListener);
  return true;
}();

}  // namespace
}  // namespace sigmascape
