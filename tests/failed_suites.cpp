#include <gtest/gtest.h>

namespace sigmascape {
namespace {

/// GoogleTest calls the tests of a suite whose SetUpTestSuite failed skipped, which CTest takes for a pass. Here they
/// fail.
class FailedSuites : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& /*test*/) override {
    if (testing::UnitTest::GetInstance()->current_test_suite()->ad_hoc_test_result().Failed())
      ADD_FAILURE() << "not run, since SetUpTestSuite failed";
  }
};

[[maybe_unused]] const bool listening = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new FailedSuites);
  return true;
}();

}  // namespace
}  // namespace sigmascape
