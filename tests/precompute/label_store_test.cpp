// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/label_store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "support/temp_folder.h"

namespace vsprite {
namespace {

struct LabelStoreTest : ::testing::Test {
  testing::TempFolder temporary;
  const std::string path_ = temporary.file("labels.sqlite");

  LabelStore open() { return std::move(*LabelStore::open(path_)); }
  ErrorCode refusal() {
    const auto store = LabelStore::open(path_);
    return store ? ErrorCode::Internal : store.error().code;
  }
  void execute(const char* sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  }
};

Answer answer(int number, bool acceptable) {
  return {{"0123456789abcdef", number, false},
          {"fedcba9876543210", number + 1, true},
          acceptable,
          number % 3 == 0,
          0.1 * number};
}

TEST_F(LabelStoreTest, GivesBackWhatItWasGivenInOrder) {
  const std::vector<Answer> given{answer(5, true), answer(3, false), answer(4, true)};
  ASSERT_TRUE(open().add({given.data(), 1}));
  ASSERT_TRUE(open().add({given.data() + 1, 2}));
  EXPECT_EQ(*open().answers(), given);
}

TEST_F(LabelStoreTest, UndoesAndRedoesToTheFirstAnswerEver) {
  for (int k = 0; k < 20; ++k) {
    const Answer one = answer(k, true);
    ASSERT_TRUE(open().add({&one, 1}));  // each in a session of its own
  }
  for (int k = 20; k-- > 0;) EXPECT_EQ((**open().undo()).a.frame, k);
  EXPECT_FALSE(open().undo()->has_value());
  EXPECT_TRUE(open().answers()->empty());
  for (int k = 0; k < 20; ++k) EXPECT_EQ((**open().redo()).a.frame, k);
  EXPECT_FALSE(open().redo()->has_value());
  EXPECT_EQ(open().answers()->size(), 20u);
}

TEST_F(LabelStoreTest, ANewAnswerEndsWhatCouldBeRedone) {
  LabelStore store = open();
  const std::vector<Answer> given{answer(1, true), answer(2, true)};
  ASSERT_TRUE(store.add(given));
  ASSERT_TRUE(store.undo());
  const Answer other = answer(2, false);
  ASSERT_TRUE(store.add({&other, 1}));
  EXPECT_FALSE(store.redo()->has_value());
  EXPECT_EQ(*store.answers(), (std::vector<Answer>{given[0], other}));
}

TEST_F(LabelStoreTest, RefusesANewerVersionAndLeavesItAlone) {
  const Answer one = answer(1, true);
  ASSERT_TRUE(open().add({&one, 1}));
  execute("PRAGMA user_version = 2");
  const auto before = testing::read_bytes(path_);
  EXPECT_EQ(refusal(), ErrorCode::UnsupportedVersion);
  EXPECT_EQ(testing::read_bytes(path_), before);
}

TEST_F(LabelStoreTest, RefusesOtherFiles) {
  testing::write_bytes(path_, {'n', 'o', 't', ' ', 'a', ' ', 'd', 'b'});
  EXPECT_EQ(refusal(), ErrorCode::BadFormat);
  std::filesystem::remove(path_);
  execute("CREATE TABLE bookmarks(url TEXT)");
  EXPECT_EQ(refusal(), ErrorCode::BadFormat);
}

TEST_F(LabelStoreTest, EveryCutOffFileIsAnErrorOrWhole) {
  std::vector<Answer> given;
  for (int k = 0; k < 300; ++k) given.push_back(answer(k, k % 2 == 0));
  ASSERT_TRUE(open().add(given));
  const auto whole = testing::read_bytes(path_);
  for (std::size_t size = 1; size < whole.size(); size += 997) {
    testing::write_bytes(path_, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    const auto store = LabelStore::open(path_);
    if (!store) continue;
    const auto read = store->answers();
    if (read) {
      EXPECT_TRUE(*read == given) << size;
    }
  }
}

// A child answers and says so; it is killed at any moment. What it said stands in the file.
TEST_F(LabelStoreTest, LosesNoAcknowledgedAnswerWhenKilled) {
  const char* wanted = std::getenv("VSPRITE_LABEL_KILLS");
  const int kills = wanted != nullptr ? std::atoi(wanted) : 20;
  int acknowledged = 0;
  for (int k = 0; k < kills; ++k) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      auto store = LabelStore::open(path_);
      for (int n = acknowledged; store; ++n) {
        const Answer one = answer(n, true);
        if (!store->add({&one, 1}) || ::write(pipe[1], "k", 1) != 1) break;
      }
      ::_exit(1);
    }
    ::close(pipe[1]);
    char said = 0;
    for (int n = 0; n < 10 + 3 * (k % 7) && ::read(pipe[0], &said, 1) == 1; ++n) ++acknowledged;
    ::usleep(static_cast<useconds_t>(137 * k % 2000));
    ::kill(child, SIGKILL);
    while (::read(pipe[0], &said, 1) == 1) ++acknowledged;
    ::close(pipe[0]);
    ::waitpid(child, nullptr, 0);
    const auto kept = open().answers();
    ASSERT_TRUE(kept) << kept.error().message;
    ASSERT_GE(std::ssize(*kept), acknowledged);
    acknowledged = static_cast<int>(kept->size());  // one more may stand than was said
    for (int n = 0; n < acknowledged; ++n)
      ASSERT_EQ((*kept)[static_cast<std::size_t>(n)].a.frame, n);
  }
  std::printf("%d answers, %d kills\n", acknowledged, kills);
  EXPECT_GT(acknowledged, 10 * kills);
}

}  // namespace
}  // namespace vsprite
