#pragma once

#include <string>
#include <vector>

#include "results/contrast.h"

namespace sigmascape::cli {

/// Whether both are of the same views of the same scene, so that their errors can be weighed against other contrasts'
/// of that kind.
[[nodiscard]] bool are_of_the_same_views(const Contrast& contrast);

/// Causes of the error that are measured at views of one kind, each switched off alone.
[[nodiscard]] std::vector<Contrast> causes(const ResultsPlan& plan, ViewKind kind);

/// Markdown: each cause with the error when it is there and when it is not, at 8 m cells.
[[nodiscard]] std::string causes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind);
/// The causes without which the RMS of dB and the relative L1 fall most, by the median of what each view's own falls
/// by, among those that are measured at the same views of one kind; with at how many views each is the largest, in
/// words.
[[nodiscard]] std::string largest_causes(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind);
/// Where shadows baked on flat ground put the paper's method off most: the view that was baked at which its bias is
/// farthest from zero, in words. Empty where that is less than a few dB, and where another cause is the largest there.
[[nodiscard]] std::string flat_shadows_text(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);
/// Markdown: the section about both kinds of views.
[[nodiscard]] std::string causes_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

}  // namespace sigmascape::cli
