#include "eval/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/eval/synthetic_run.hpp"
#include "tests/support/markup.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::make_synthetic_run;
using testing::markup_faults;
using ::testing::Not;
using testing::Outcome;

const std::string& recovered_page() {
  static const std::string page = report_html(make_synthetic_run(Outcome::Recovered));
  return page;
}

TEST(Report, IsWellFormed) { EXPECT_THAT(markup_faults(recovered_page()), IsEmpty()); }

TEST(Report, LoadsNothingFromElsewhereAndRunsNoScript) {
  EXPECT_THAT(recovered_page(), Not(HasSubstr("http:")));
  EXPECT_THAT(recovered_page(), Not(HasSubstr("https:")));
  EXPECT_THAT(recovered_page(), Not(HasSubstr("<script")));
  EXPECT_THAT(recovered_page(), Not(HasSubstr("url(")));
  EXPECT_THAT(recovered_page(), HasSubstr("default-src 'none'"));
}

TEST(Report, EscapesWhateverComesFromOutside) {
  EXPECT_THAT(recovered_page(), Not(HasSubstr("<made up>")));
  EXPECT_THAT(recovered_page(), HasSubstr("&lt;made up&gt; &amp; painted"));
  EXPECT_THAT(recovered_page(), Not(HasSubstr("drive<1>")));
  EXPECT_THAT(recovered_page(), HasSubstr("sigma: &lt;0.3&gt;"));
}

TEST(Report, FitsAPhone) {
  EXPECT_THAT(recovered_page(), HasSubstr("width=device-width, initial-scale=1"));
}

TEST(Report, SaysFirstWhetherItWorked) {
  EXPECT_THAT(recovered_page(), HasSubstr("Partly located: lost on the way, found again"));
  EXPECT_THAT(report_html(make_synthetic_run(Outcome::Located)), HasSubstr(">Located: 100"));
  EXPECT_THAT(report_html(make_synthetic_run(Outcome::Lost)), HasSubstr(">Lost: at the end"));
}

TEST(Report, StatesTheUncertaintyOfTheReference) {
  EXPECT_THAT(recovered_page(), HasSubstr("its own uncertainty is 0.50"));
}

TEST(Report, ClaimsNothingWithoutAReference) {
  RunRecord record = make_synthetic_run(Outcome::Located);
  record.reference.reset();
  const std::string page = report_html(record);
  EXPECT_THAT(markup_faults(page), IsEmpty());
  EXPECT_THAT(page, HasSubstr("No reference to compare with"));
  EXPECT_THAT(page, Not(HasSubstr("Located")));
  EXPECT_THAT(page, Not(HasSubstr("Position error")));
}

TEST(Report, OfAnEmptyRunIsStillAPage) {
  const std::string page = report_html(RunRecord{});
  EXPECT_THAT(markup_faults(page), IsEmpty());
  EXPECT_THAT(page, HasSubstr("No reference to compare with"));
}

TEST(Report, WithoutScansOrParticlesLeavesThoseSectionsOut) {
  RunRecord record = make_synthetic_run(Outcome::Recovered);
  record.run.steps.clear();
  record.snapshots.clear();
  const std::string page = report_html(record);
  EXPECT_THAT(markup_faults(page), IsEmpty());
  EXPECT_THAT(page, Not(HasSubstr("Where it goes wrong")));
  EXPECT_THAT(page, Not(HasSubstr("What the filter considered")));
  EXPECT_THAT(page, HasSubstr("Position error"));
}

TEST(Report, IsTheSameForTheSameRun) {
  EXPECT_EQ(report_html(make_synthetic_run(Outcome::Recovered)), recovered_page());
}

TEST(MarkupFaults, AreFound) {
  EXPECT_THAT(markup_faults("<p>a<b>c</b></p>"), IsEmpty());
  EXPECT_THAT(markup_faults("<p>a<b>c</p></b>"), Not(IsEmpty()));
  EXPECT_THAT(markup_faults("<p class=x>a</p>"), Not(IsEmpty()));
  EXPECT_THAT(markup_faults("<p>a & b</p>"), Not(IsEmpty()));
  EXPECT_THAT(markup_faults("<p>never closed"), Not(IsEmpty()));
}

}  // namespace
}  // namespace sketchloc
