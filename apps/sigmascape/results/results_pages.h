#pragma once

namespace sigmascape::cli {

/// A page of results among the project's.
struct ResultsPage {
  const char* words;  ///< what it is about
  const char* page;   ///< named from the root of the project
};

/// Those that `make results` writes; the first is of the paper's scene, the others lie in folders beside it.
inline constexpr ResultsPage results_pages[] = {{"the paper's scene", "docs/results/README.md"},
                                                {"the same of real materials", "docs/results/itu/README.md"},
                                                {"Bilbao", "docs/results/bilbao/README.md"},
                                                {"San Francisco", "docs/results/san_francisco/README.md"}};

}  // namespace sigmascape::cli
