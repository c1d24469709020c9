#include "coupler/vertex_index.hpp"

#include <gtest/gtest.h>

using polynya::coupler::VertexIndex;

TEST(VertexIndex, FindsVerticesInWhateverOrderTheyAreAskedFor) {
  const std::vector<std::int64_t> ids{3, 5, 9, 40, 31, 33};  // nodes ascend, particles are in the order of their birth
  VertexIndex index(ids);
  for (const int v : {0, 1, 2, 3, 4, 5, 5, 0, 4, 3, 1}) EXPECT_EQ(index.find(ids[static_cast<std::size_t>(v)]), v);
}

TEST(VertexIndex, KnowsWhatIsNotThere) {
  const std::vector<std::int64_t> ids{3, 5, 9};
  VertexIndex index(ids);
  for (const std::int64_t other : {0, 4, 10}) {
    EXPECT_EQ(index.find(other), -1);
    EXPECT_EQ(index.find(5), 1);
  }
  EXPECT_EQ(VertexIndex({}).find(3), -1);
}
