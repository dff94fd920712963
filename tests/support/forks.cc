// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The program many times over: each run is a copy of this process, which has
// loaded the libraries already. A line of standard input is a run: the folder
// to run in and the arguments, separated by tabs. What it prints goes to the
// files stdout and stderr of that folder; its exit code is printed, or the
// number of the signal that ended it, below zero. A run that takes longer than
// it may ends by the signal of an alarm.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

int
main_of_program(int argc, char *argv[]);

namespace
{
  constexpr unsigned int seconds      = 20;
  constexpr rlim_t       memory       = rlim_t(3) << 30;
  constexpr rlim_t       largest_file = rlim_t(100) << 20;

  void
  print_to(const char *const file, const int stream)
  {
    const int fd = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(fd, stream);
    close(fd);
  }

  void
  allow(const decltype(RLIMIT_AS) resource, const rlim_t amount)
  {
    const rlimit limit = {amount, amount};
    setrlimit(resource, &limit);
  }

  [[noreturn]] void
  run(std::vector<std::string> &words)
  {
    if (chdir(words[0].c_str()) != 0)
      _exit(99);
    print_to("stdout", STDOUT_FILENO);
    print_to("stderr", STDERR_FILENO);
    allow(RLIMIT_AS, memory);
    allow(RLIMIT_FSIZE, largest_file);
    allow(RLIMIT_CORE, 0);
    alarm(seconds);
    std::vector<char *> arguments;
    for (std::string &word : words) // the first one stands for the program
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::exit(
      main_of_program(static_cast<int>(words.size()), arguments.data()));
  }
} // namespace

int
main()
{
  for (std::string line; std::getline(std::cin, line);)
    {
      std::vector<std::string> words;
      std::istringstream       stream(line);
      for (std::string word; std::getline(stream, word, '\t');)
        words.push_back(word);
      const pid_t child = fork();
      if (child == 0)
        run(words);
      int status = 0;
      waitpid(child, &status, 0);
      std::cout << (WIFSIGNALED(status) ? -WTERMSIG(status) :
                                          WEXITSTATUS(status))
                << std::endl;
    }
  return 0;
}
