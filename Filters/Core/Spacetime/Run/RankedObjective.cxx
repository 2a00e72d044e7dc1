// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/RankedObjective.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace waft
{
namespace
{

enum class Order : char
{
  Make,
  Drop,
  Evaluate,
  BringRows,
  WriteLists,
  ReadLists,
  MarkLists,
  RewindLists,
  End
};

FrameRange FramesOf(const TimeLevel& level, const Communicator& ranks, int rank)
{
  const std::size_t frames = level.NumberOfFrames();
  const auto size = static_cast<std::size_t>(ranks.Size());
  const auto r = static_cast<std::size_t>(rank);
  return { frames * r / size, frames * (r + 1) / size };
}

/// Blocks of so many values, from frame `frames.Begin` of a vector of all frames.
template <class T>
void Blocks(PeerStream& stream, const FrameRange& frames, std::size_t each, T* all)
{
  stream.Raw(all + frames.Begin * each, frames.Size() * each * sizeof(T));
}

/// The frames that the steps which a rank evaluates lead to, and its first.
FrameRange StepsOf(const FrameRange& frames, const TimeLevel& level)
{
  return frames.Widened(0, 1, level.NumberOfFrames());
}

/// The frames whose lists a rank uses.
FrameRange ListsOf(const FrameRange& frames, const TimeLevel& level)
{
  return frames.Widened(1, 0, level.NumberOfFrames());
}

/// An order to all other ranks, for the objective at an address of rank 0.
void Give(Communicator& ranks, Order order, const void* objective)
{
  BroadcastStream stream(ranks);
  auto id = reinterpret_cast<std::uintptr_t>(objective);
  stream.Values(order, id);
}

/// What evaluates some frames for an objective of rank 0.
class Server
{
public:
  Server(const SpacetimeModel& model, const ParallelFor& parallel, Communicator& ranks) :
    Model(model), Ranks(ranks)
  {
    bool keepsLists = false;
    BroadcastStream stream(ranks);
    Serialise(stream, this->Level);
    stream.Value(keepsLists);
    this->Frames = FramesOf(this->Level, ranks, ranks.Rank());
    this->Objective = std::make_unique<SpacetimeObjective>(
      model, this->Fields, this->Level, parallel, FastestSphKernels(), keepsLists);
    const std::size_t size = this->Level.NumberOfFrames() * model.FrameSize();
    this->State.resize(size);
    this->Gradient.resize(size);
  }
  void Obey(Order order)
  {
    PeerStream writer(this->Ranks, 0, false);
    PeerStream reader(this->Ranks, 0, true);
    SpacetimeObjective& objective = *this->Objective;
    switch (order)
    {
      case Order::Evaluate:
        this->Evaluate(reader, writer);
        break;
      case Order::BringRows:
        Blocks(writer, StepsOf(this->Frames, this->Level), 9 * this->Model.Stride(),
               objective.FrameRows(0));
        break;
      case Order::WriteLists:
        objective.SerialiseLists(writer, this->Frames);
        break;
      case Order::ReadLists:
        objective.SerialiseLists(reader, ListsOf(this->Frames, this->Level));
        break;
      case Order::MarkLists:
        objective.MarkLists();
        break;
      case Order::RewindLists:
        objective.RewindLists();
        break;
      case Order::Make:
      case Order::Drop:
      case Order::End:
        break; // not its own to do
    }
  }

private:
  void Evaluate(PeerStream& reader, PeerStream& writer)
  {
    bool wantsGradient = false;
    BroadcastStream all(this->Ranks);
    all.Value(wantsGradient);
    Serialise(all, this->Fields);
    const std::size_t size = this->Model.FrameSize();
    Blocks(reader, this->Objective->FramesRead(this->Frames), size, this->State.data());
    this->Objective->EvaluateFrames(this->Frames, this->State,
                                    wantsGradient ? &this->Gradient : nullptr);
    Blocks(writer, this->Frames, 1, &this->Objective->FrameSum(0));
    if (wantsGradient)
    {
      Blocks(writer, this->Frames, size, this->Gradient.data());
    }
  }

  const SpacetimeModel& Model;
  Communicator& Ranks;
  TimeLevel Level;
  AirFields Fields;
  FrameRange Frames;
  std::unique_ptr<SpacetimeObjective> Objective;
  StateVector State, Gradient;
};

/// Rank 0's, where there are others.
class RankedObjective : public SpacetimeObjective
{
public:
  RankedObjective(const SpacetimeModel& model, const AirFields& fields, const TimeLevel& level,
                  const ParallelFor& parallel, bool keepsLists, Communicator& ranks);
  ~RankedObjective() override;

  bool Evaluate(const StateVector& state, StateVector* gradient, SpacetimeTerms& terms,
                Monitor* monitor = nullptr) override;
  void BringRows() override;
  void SerialiseLists(StateArchive& stream) override;
  void MarkLists() override;
  void RewindLists() override;

private:
  Communicator& Ranks;
};

RankedObjective::RankedObjective(const SpacetimeModel& model, const AirFields& fields,
                                 const TimeLevel& level, const ParallelFor& parallel,
                                 bool keepsLists, Communicator& ranks) :
  SpacetimeObjective(model, fields, level, parallel, FastestSphKernels(), keepsLists),
  Ranks(ranks)
{
  Give(ranks, Order::Make, this);
  BroadcastStream stream(ranks);
  Serialise(stream, const_cast<TimeLevel&>(level)); // which writing leaves as it is
  stream.Value(keepsLists);
}

RankedObjective::~RankedObjective()
{
  Give(this->Ranks, Order::Drop, this);
}

bool RankedObjective::Evaluate(const StateVector& state, StateVector* gradient,
                               SpacetimeTerms& terms, Monitor* monitor)
{
  Give(this->Ranks, Order::Evaluate, this);
  BroadcastStream all(this->Ranks);
  bool wantsGradient = gradient != nullptr;
  all.Value(wantsGradient);
  Serialise(all, const_cast<AirFields&>(this->Fields()));
  const std::size_t size = this->Model().FrameSize();
  for (int r = 1; r < this->Ranks.Size(); ++r)
  {
    PeerStream stream(this->Ranks, r, false);
    Blocks(stream, this->FramesRead(FramesOf(this->Level(), this->Ranks, r)), size,
           const_cast<float*>(state.data()));
  }
  const bool done =
    this->EvaluateFrames(FramesOf(this->Level(), this->Ranks, 0), state, gradient, monitor);
  for (int r = 1; r < this->Ranks.Size(); ++r)
  {
    PeerStream stream(this->Ranks, r, true);
    const FrameRange frames = FramesOf(this->Level(), this->Ranks, r);
    Blocks(stream, frames, 1, &this->FrameSum(0));
    if (gradient != nullptr)
    {
      Blocks(stream, frames, size, gradient->data());
    }
  }
  if (done)
  {
    terms = this->Sum();
  }
  return done;
}

void RankedObjective::BringRows()
{
  Give(this->Ranks, Order::BringRows, this);
  for (int r = 1; r < this->Ranks.Size(); ++r)
  {
    // The first of them is the step from the rank before, whose work that is, and the same here.
    PeerStream stream(this->Ranks, r, true);
    Blocks(stream, StepsOf(FramesOf(this->Level(), this->Ranks, r), this->Level()),
           9 * this->Model().Stride(), this->FrameRows(0));
  }
}

void RankedObjective::SerialiseLists(StateArchive& stream)
{
  if (stream.IsReading())
  {
    SpacetimeObjective::SerialiseLists(stream);
  }
  Give(this->Ranks, stream.IsReading() ? Order::ReadLists : Order::WriteLists, this);
  for (int r = 1; r < this->Ranks.Size(); ++r)
  {
    const FrameRange frames = FramesOf(this->Level(), this->Ranks, r);
    PeerStream peer(this->Ranks, r, !stream.IsReading());
    SpacetimeObjective::SerialiseLists(peer, stream.IsReading() ? ListsOf(frames, this->Level())
                                                                : frames);
  }
  if (!stream.IsReading())
  {
    SpacetimeObjective::SerialiseLists(stream);
  }
}

void RankedObjective::MarkLists()
{
  Give(this->Ranks, Order::MarkLists, this);
  SpacetimeObjective::MarkLists();
}

void RankedObjective::RewindLists()
{
  Give(this->Ranks, Order::RewindLists, this);
  SpacetimeObjective::RewindLists();
}

} // namespace

ObjectiveMaker RankedObjectives(const SpacetimeModel& model, const ParallelFor& parallel,
                                Communicator& ranks)
{
  if (ranks.Size() == 1)
  {
    return Objectives(model, parallel);
  }
  return
    [&model, &ranks, parallel](const AirFields& fields, const TimeLevel& level, bool keepsLists)
  { return std::make_unique<RankedObjective>(model, fields, level, parallel, keepsLists, ranks); };
}

Result ServeEvaluations(const SpacetimeModel& model, const ParallelFor& parallel,
                        Communicator& ranks)
{
  std::map<std::uintptr_t, std::unique_ptr<Server>> servers;
  for (;;)
  {
    BroadcastStream stream(ranks);
    Order order = Order::End;
    std::uintptr_t id = 0;
    stream.Values(order, id);
    if (order == Order::Make)
    {
      servers[id] = std::make_unique<Server>(model, parallel, ranks);
    }
    else if (order == Order::Drop)
    {
      servers.erase(id);
    }
    else if (order == Order::End)
    {
      bool isGood = false, isStopped = false;
      std::string message;
      stream.Values(isGood, isStopped);
      stream.Text(message);
      return isStopped ? Result::Stopped() : isGood ? Result::Ok() : Result::Error(message);
    }
    else
    {
      servers.at(id)->Obey(order);
    }
  }
}

void EndEvaluations(const Result& result, Communicator& ranks)
{
  Give(ranks, Order::End, nullptr);
  BroadcastStream stream(ranks);
  bool isGood(result);
  bool isStopped = result.IsStopped();
  std::string message = result.Message();
  stream.Values(isGood, isStopped);
  stream.Text(message);
}

} // namespace waft
