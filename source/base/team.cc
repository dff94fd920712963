// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/team.h"

#include "conetact/base/errors.h"
#include "conetact/base/index.h"
#include "conetact/base/interruption.h"
#include "conetact/base/process.h"

#include <deal.II/base/exceptions.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <thread>

namespace conetact
{
  namespace
  {
    using Letters = Eigen::Matrix<char, Eigen::Dynamic, 1>;

    int
    n_of_run()
    {
      return static_cast<int>(ProcessSession::n_processes());
    }

    /** MPI may not run where there is one process. */
    Communicator
    first_of_run(const int n)
    {
      return n_of_run() == 1 ? Communicator() : Communicator::of_first(n);
    }

    /** None: all processes of the run. */
    std::optional<Communicator> &
    formed()
    {
      static std::optional<Communicator> made;
      return made;
    }

    /** How processes tell each other that something has failed. */
    constexpr char in_input = 'i', in_analysis = 'a', in_writing = 'w',
                   in_memory = 'm', elsewhere = 'e', nothing = '-';

    /** Its kind, and the sentence behind it. */
    std::string
    describe(const std::exception_ptr &error)
    {
      if (!error)
        return {nothing};
      try
        {
          std::rethrow_exception(error);
        }
      catch (const InputError &why)
        {
          return in_input + std::string(why.what());
        }
      catch (const AnalysisError &why)
        {
          return in_analysis + std::string(why.what());
        }
      catch (const WriteError &why)
        {
          return in_writing + std::string(why.what());
        }
      catch (const std::bad_alloc &)
        {
          return {in_memory};
        }
      catch (const std::exception &why)
        {
          return elsewhere + std::string(why.what());
        }
    }

    [[noreturn]] void
    fail(const char kind, const std::string &why)
    {
      switch (kind)
        {
          case in_input:
            throw InputError(why);
          case in_analysis:
            throw AnalysisError(why);
          case in_writing:
            throw WriteError(why);
          case in_memory:
            throw std::bad_alloc();
          default:
            throw std::runtime_error(why);
        }
    }

    /** Texts of all processes of the team. */
    std::vector<std::string>
    gather_texts(const std::string &own)
    {
      Letters part(static_cast<Eigen::Index>(own.size()) + 1);
      std::copy_n(own.c_str(), own.size() + 1, part.data());
      const Letters            all = team().gather_all(part);
      std::vector<std::string> texts;
      for (Eigen::Index k = 0; k < all.size();
           k += static_cast<Eigen::Index>(texts.back().size()) + 1)
        texts.emplace_back(all.data() + k);
      return texts;
    }

    /** A failed process waits so long for others: those that find the same
     * come soon; the first one has the word before others. */
    std::chrono::seconds
    patience()
    {
      constexpr int of_first = 3, of_others = 20;
      return std::chrono::seconds(ProcessSession::speaks() ? of_first :
                                                             of_others);
    }
  } // namespace



  const Communicator &
  team()
  {
    if (!formed())
      formed() = first_of_run(n_of_run());
    return *formed();
  }



  void
  form_team(const int n)
  {
    Assert(n >= 1 && n <= n_of_run(),
           dealii::ExcMessage("A team is of processes of the run."));
    formed() = first_of_run(n);
  }



  bool
  is_in_team()
  {
    return team().is_member();
  }



  void
  leave_to_first()
  {
    if (team().size() > 1)
      formed() = first_of_run(1);
  }



  int
  processes_for(const Eigen::Index n_unknowns, const Eigen::Index fewest)
  {
    Assert(fewest > 0, dealii::ExcMessage("A process is worth some unknowns."));
    return static_cast<int>(
      std::clamp<Eigen::Index>(n_unknowns / fewest, 1, team().size()));
  }



  void
  agree(const std::function<void()> &f)
  {
    if (team().size() == 1)
      return f();
    std::exception_ptr own;
    try
      {
        f();
      }
    catch (...)
      {
        own = std::current_exception();
      }
    const std::vector<std::string> found = gather_texts(describe(own));
    const auto                     first =
      std::find_if(found.begin(), found.end(), [](const std::string &text) {
        return text[0] != nothing;
      });
    if (first == found.end())
      return;
    const auto p = first - found.begin();
    if (p == team().rank())
      std::rethrow_exception(own);
    fail((*first)[0],
         (p == 0 ? "" :
                   "Process " + std::to_string(p + 1) + " of " +
                     std::to_string(found.size()) + ": ") +
           first->substr(1));
  }



  void
  first_decides(bool &decision)
  {
    double number = decision ? 1. : 0.;
    first_decides(number);
    decision = number > 0;
  }



  void
  first_decides(double &number)
  {
    team().broadcast(Eigen::Map<Eigen::VectorXd>(&number, 1));
  }



  void
  first_decides(std::string &text)
  {
    std::vector<char> letters(text.begin(), text.end());
    team().broadcast(letters);
    text.assign(letters.begin(), letters.end());
  }



  bool
  wants_to_stop()
  {
    bool is_wanted = Interruption::is_wanted();
    first_decides(is_wanted);
    return is_wanted;
  }



  /* By a checksum as that of Fowler, Noll and Vo, of numbers in place of
     bytes. */
  void
  demand_equal(
    const std::vector<std::pair<const double *, Eigen::Index>> &numbers)
  {
    if (team().size() == 1)
      return;
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const auto &[array, size] : numbers)
      for (Eigen::Index k = 0; k < size; ++k)
        {
          std::uint64_t bits = 0;
          std::memcpy(&bits, array + k, sizeof(bits));
          hash = (hash ^ (bits + (bits >> 32))) * 0x100000001b3;
        }
    using Hashes     = Eigen::Matrix<std::uint64_t, Eigen::Dynamic, 1>;
    const Hashes all = team().gather_all(Hashes(Hashes::Constant(1, hash)));
    if ((all.array() != hash).any())
      throw AnalysisError(
        "Processes have come to different results, which must not happen. Run "
        "the scene by processors of one kind, or by one process, and report "
        "it.");
  }



  std::vector<int>
  meet(const int code)
  {
    std::vector<int> codes(at(n_of_run()), code);
    if (n_of_run() == 1)
      return codes;
    using Clock       = std::chrono::steady_clock;
    const auto  start = Clock::now();
    MPI_Request request;
    int         done = 0;
    MPI_Iallgather(
      &code, 1, MPI_INT, codes.data(), 1, MPI_INT, MPI_COMM_WORLD, &request);
    constexpr std::chrono::milliseconds at_once{1}, longest_sleep{10};
    for (;;)
      {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done != 0)
          return codes;
        const auto waited = Clock::now() - start;
        if (code > 0 && waited > patience())
          return {};
        if (waited > at_once)
          std::this_thread::sleep_for(
            std::min<Clock::duration>(waited / 8, longest_sleep));
        else
          std::this_thread::yield();
      }
  }



  std::vector<Needs>
  needs_of_processes(const std::uint64_t elements)
  {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval &t) {
      return static_cast<double>(t.tv_sec) +
             1e-6 * static_cast<double>(t.tv_usec);
    };
    const Traffic   sent = traffic();
    Eigen::VectorXd own(9);
    own << 1024. * static_cast<double>(usage.ru_maxrss),
      seconds(usage.ru_utime) + seconds(usage.ru_stime),
      static_cast<double>(elements), static_cast<double>(sent.ghosts),
      static_cast<double>(sent.messages), static_cast<double>(sent.bytes),
      static_cast<double>(sent.n_collective),
      static_cast<double>(sent.collective_bytes), sent.waited;
    const Eigen::VectorXd found = team().gather_all(own);
    std::vector<Needs>    needs;
    for (Eigen::Index p = 0; p < found.size(); p += own.size())
      needs.push_back({found(p),
                       found(p + 1),
                       found(p + 2),
                       found(p + 3),
                       found(p + 4),
                       found(p + 5),
                       found(p + 6),
                       found(p + 7),
                       found(p + 8)});
    return needs;
  }
} // namespace conetact
