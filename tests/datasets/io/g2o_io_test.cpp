#include "datasets/io/g2o_io.hpp"

#include <stdexcept>

#include "tests/datasets/io/files.hpp"

namespace sketchloc {
namespace {

using testing::content_of;
using testing::FailsWith;

constexpr const char* kSquare =
    "# a square\n"
    "EDGE_SE2 7 8 1 0 1.5 500 1 2 400 3 1000\n"
    "VERTEX_SE2 7 0.1 -2e-3 6.282233\n"
    "\n"
    "VERTEX_SE2 8 1 0 -1.5\r\n"
    "VERTEX_SE2 20 3 4 0\n"
    "FIX 8 20\n"
    "EDGE_SE2 20 7 0.5 0.25 -3 1 0 0 1 0 1\n"
    "EDGE_PRIOR_SE2 7 1 2 3 4 0 0 4 0 9\n";

class G2o : public testing::FileTest {
 protected:
  auto reading(std::string_view content) const {
    const std::filesystem::path g2o = file("a.g2o", content);
    return [g2o] { read_g2o(g2o); };
  }
};

TEST_F(G2o, ReadsVerticesAndEdgesInAnyOrder) {
  const PoseGraph graph = read_g2o(file("a.g2o", kSquare));
  ASSERT_EQ(graph.vertices.size(), 3U);
  EXPECT_EQ(graph.vertices[0].id, 7);
  EXPECT_EQ(graph.vertices[0].frame_from_body,
            (GraphPose{.x = 0.1, .y = -2e-3, .yaw_rad = 6.282233}));
  EXPECT_FALSE(graph.vertices[0].is_fixed);
  EXPECT_TRUE(graph.vertices[1].is_fixed);
  EXPECT_TRUE(graph.vertices[2].is_fixed);
  ASSERT_EQ(graph.edges.size(), 3U);
  EXPECT_EQ(graph.edges[0].first, 0U);
  EXPECT_EQ(graph.edges[0].second, 1U);
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  information.topLeftCorner<3, 3>() << 500, 1, 2, 1, 400, 3, 2, 3, 1000;
  EXPECT_EQ(graph.edges[0].information, information);
  EXPECT_EQ(graph.edges[2].kind, EdgeKind::Prior);
}

TEST_F(G2o, EdgesBetweenNeighboursAreStepsAndOthersMayBeWrong) {
  const PoseGraph graph = read_g2o(file("a.g2o", kSquare));
  EXPECT_FALSE(graph.edges[0].may_be_wrong);
  EXPECT_TRUE(graph.edges[1].may_be_wrong);
  EXPECT_FALSE(graph.edges[2].may_be_wrong);
}

TEST_F(G2o, GivesBackWhatWasWrittenNumberForNumber) {
  PoseGraph graph = read_g2o(gzip_file("a.g2o.gz", kSquare));
  graph.vertices[0].frame_from_body.x = 0.1 + 0.2;
  graph.edges[0].measured.yaw_rad = 1.0 / 3.0;
  write_g2o(missing("b.g2o"), graph);
  EXPECT_EQ(read_g2o(missing("b.g2o")), graph);
  EXPECT_EQ(content_of(missing("b.g2o")), g2o_text(graph));
}

TEST_F(G2o, SaysWhereAndWhatIsWrong) {
  EXPECT_THAT(reading("VERTEX_SE2 0 1 2\n"), FailsWith("a.g2o:1: theta"));
  EXPECT_THAT(reading("VERTEX_SE2 0 1 2 nan\n"), FailsWith("a.g2o:1: theta: expected a number"));
  EXPECT_THAT(reading("VERTEX_SE2 0 1 2 0 4\n"), FailsWith("a.g2o:1: columns"));
  EXPECT_THAT(reading("VERTEX_SE2 0 1 2 3\nVERTEX_SE2 0 1 2 3\n"),
              FailsWith("a.g2o:2: id: expected an id of its own"));
  EXPECT_THAT(reading("\nVERTEX_SE3:QUAT 0 1 2 3 0 0 0 1\n"),
              FailsWith("a.g2o:2: tag: expected VERTEX_SE2"));
  EXPECT_THAT(reading("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 5 1 0 0 1 0 0 1 0 1\n"),
              FailsWith("a.g2o:2: id: expected the id of a vertex, found 5; add VERTEX_SE2 5"));
  EXPECT_THAT(reading("VERTEX_SE2 0 0 0 0\nFIX 3\n"), FailsWith("a.g2o:2: id"));
  EXPECT_THAT(reading("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 0 1 0 0 1 0 0 1 0 1\n"),
              FailsWith("a.g2o:2: second id"));
  EXPECT_THAT(reading("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 1 5 0 1 0 1\n"),
              FailsWith("a.g2o:2: information"));
  EXPECT_THAT(reading("# nothing\n"), FailsWith("a.g2o: vertices: expected lines of VERTEX_SE2"));
  EXPECT_THAT([this] { read_g2o(missing("none.g2o")); }, FailsWith("cannot be opened"));
}

TEST_F(G2o, HasNoPlaceForScalesAndOtherEdges) {
  PoseGraph graph;
  graph.vertices.resize(2);
  graph.edges.push_back(manhattan_edge(0, 1, ManhattanAxis::Forward, 0.1, 0.1));
  EXPECT_THROW(g2o_text(graph), std::invalid_argument);
  graph.edges.clear();
  graph.vertices[0].kind = VertexKind::Sim2;
  EXPECT_THROW(g2o_text(graph), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
