// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LeastCost.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <numeric>
#include <queue>

namespace waft
{

namespace
{

constexpr std::size_t None = ColumnOffer::None;

/// Prices keep the cost of every pair, less both prices, from zero up, and zero where a row has its
/// column. Being left out is a column of the row's own, of which the price stays zero, as does that
/// of a column that is free.
class Assigner
{
public:
  explicit Assigner(ColumnSearch& search) :
    Search(search), LeftOut(search.LeftOut()), RowPrices(search.LeftOut().size()),
    States(search.Columns()), RowOf(search.Columns(), None), ColumnOf(search.LeftOut().size(), None)
  {
  }

  Assignment Run()
  {
    // Prices that were guessed may be left on a column that nobody takes: then it is not the least.
    // Only where there are rows for all columns is that unlikely.
    if (this->Search.Range() > 0.0 && this->LeftOut.size() >= this->States.size())
    {
      this->GuessPrices();
    }
    this->Settle();
    if (this->IsOff())
    {
      this->StartAnew();
      this->Settle();
    }
    return this->Result();
  }

private:
  void Settle()
  {
    for (const std::size_t row : this->Bid(0.0))
    {
      this->TakeIn(row);
    }
  }

  /// Prices by auctions in which a bid raises by ever less.
  void GuessPrices()
  {
    RankedCost most;
    for (std::size_t c = 0; c < this->States.size(); ++c)
    {
      most = std::max(most, this->Search.FirstPrice(c));
    }
    for (std::size_t c = 0; c < this->States.size(); ++c)
    {
      this->SetState(c, { this->Search.FirstPrice(c) - most, false, false });
    }
    const double finest = this->Search.Range() / (FinestPart * double(this->LeftOut.size()));
    for (double raise = this->Search.Range() / FirstPart; raise > finest; raise /= RefineBy)
    {
      this->Bid(raise);
      this->Release();
    }
  }

  void StartAnew()
  {
    for (std::size_t c = 0; c < this->States.size(); ++c)
    {
      this->SetState(c, ColumnSearch::State());
    }
    std::fill(this->RowOf.begin(), this->RowOf.end(), None);
    std::fill(this->ColumnOf.begin(), this->ColumnOf.end(), None);
    std::fill(this->RowPrices.begin(), this->RowPrices.end(), RankedCost());
  }

  bool IsPriced(std::size_t column) const { return this->States[column].Price < RankedCost(); }

  /// Has a free column kept a price?
  bool IsOff() const
  {
    for (std::size_t c = 0; c < this->States.size(); ++c)
    {
      if (this->RowOf[c] == None && this->IsPriced(c))
      {
        return true;
      }
    }
    return false;
  }

  /// Frees all columns. Those that nobody had lose their prices.
  void Release()
  {
    for (std::size_t c = 0; c < this->States.size(); ++c)
    {
      if (this->RowOf[c] != None)
      {
        this->SetState(c, { this->States[c].Price, false, false });
      }
      else if (this->IsPriced(c))
      {
        this->SetState(c, ColumnSearch::State());
      }
    }
    std::fill(this->RowOf.begin(), this->RowOf.end(), None);
    std::fill(this->ColumnOf.begin(), this->ColumnOf.end(), None);
  }

  /// One auction: a row takes its best column and pays what brings it to the second best and
  /// `raise` beyond; who had it bids again. With a raise of zero, prices are exact for who has a
  /// column or is left out. Returns the rows that came to no end.
  std::vector<std::size_t> Bid(double raise)
  {
    std::deque<std::size_t> bidders(this->LeftOut.size());
    std::iota(bidders.begin(), bidders.end(), std::size_t(0));
    std::vector<std::size_t> open;
    for (std::size_t bids = MostBids * this->LeftOut.size(); !bidders.empty(); --bids)
    {
      if (bids == 0)
      {
        open.insert(open.end(), bidders.begin(), bidders.end());
        break;
      }
      const std::size_t row = bidders.front();
      bidders.pop_front();
      const auto [best, second] = this->Search.Best(row);
      const RankedCost& out = this->LeftOut[row];
      if (!best.Exists() || out < best.Cost)
      {
        this->RowPrices[row] = out;
        continue;
      }
      const std::size_t column = best.Column;
      const std::size_t before = this->RowOf[column];
      const RankedCost next = second.Exists() && second.Cost < out ? second.Cost : out;
      RankedCost rise = next - best.Cost;
      rise.Amount += raise;
      if (before != None && !(RankedCost() < rise))
      {
        this->RowPrices[row] = RankedCost();
        open.push_back(row); // a bid would raise nothing and could go on for ever
        continue;
      }
      // A free column is had for nothing where prices are to be exact.
      const bool isFree = before == None && raise == 0.0;
      const RankedCost price = this->States[column].Price;
      this->SetState(column, { isFree ? price : price - rise, true, false });
      this->RowPrices[row] = isFree ? best.Cost : next;
      this->RowOf[column] = row;
      this->ColumnOf[row] = column;
      if (before != None)
      {
        this->ColumnOf[before] = None;
        this->RowPrices[before] = RankedCost();
        bidders.push_front(before);
      }
    }
    std::sort(open.begin(), open.end());
    return open;
  }

  /// A row's best column on the cheapest path to the row. Of equal ones, free columns come first,
  /// then rows that the search came to earlier.
  struct Reach
  {
    ColumnOffer Offer; // its cost is the length of the path
    std::size_t Row = 0;
    std::size_t Order = 0;

    bool operator>(const Reach& other) const
    {
      return other.Offer.IsBefore(this->Offer) ||
             (!this->Offer.IsBefore(other.Offer) && this->Order > other.Order);
    }
  };

  /// A column that changes hands: its way from the row that reached it.
  struct Step
  {
    std::size_t Column = 0;
    std::size_t From = 0;
    RankedCost Distance;
  };

  /// Takes a row in along the cheapest path of columns that change hands.
  void TakeIn(std::size_t start)
  {
    std::priority_queue<Reach, std::vector<Reach>, std::greater<>> reached;
    std::vector<Step> steps;                  // columns that were come to, each once
    RankedCost leaving = RankedCost::Never(); // of the path on which a row is left out
    std::size_t left = None;
    std::size_t sink = None; // a free column
    std::vector<RankedCost> distances;
    std::size_t row = start;
    RankedCost distance;
    while (true)
    {
      distances.push_back(distance);
      const RankedCost out = distance + this->LeftOut[row] - this->RowPrices[row];
      if (left == None || out < leaving)
      {
        leaving = out;
        left = row;
      }
      this->Look(row, distance, distances.size() - 1, reached);
      // What rows saw in a column that was come to since, they see no more.
      while (!reached.empty() && this->States[reached.top().Offer.Column].IsClosed)
      {
        const Reach stale = reached.top();
        reached.pop();
        this->Look(stale.Row, distances[stale.Order], stale.Order, reached);
      }
      if (reached.empty() || leaving < reached.top().Offer.Cost)
      {
        break;
      }
      const Reach next = reached.top();
      const std::size_t column = next.Offer.Column;
      distance = next.Offer.Cost;
      steps.push_back({ column, next.Row, distance });
      row = this->RowOf[column];
      if (row == None)
      {
        sink = column;
        break;
      }
      ColumnSearch::State state = this->States[column];
      state.IsClosed = true;
      this->SetState(column, state);
    }
    const RankedCost total = sink == None ? leaving : distance;
    this->RowPrices[start] = this->RowPrices[start] + total;
    for (const Step& step : steps)
    {
      this->From[step.Column] = step.From;
      if (step.Column != sink)
      {
        const RankedCost change = total - step.Distance;
        RankedCost& price = this->RowPrices[this->RowOf[step.Column]];
        price = price + change;
        this->SetState(step.Column, { this->States[step.Column].Price - change, true, false });
      }
    }
    std::size_t column = sink;
    if (sink == None)
    {
      column = this->ColumnOf[left];
      this->ColumnOf[left] = None;
    }
    else
    {
      this->SetState(sink, { this->States[sink].Price, true, false });
    }
    while (column != None)
    {
      const std::size_t taker = this->From[column];
      const std::size_t before = this->ColumnOf[taker];
      this->RowOf[column] = taker;
      this->ColumnOf[taker] = column;
      column = before;
    }
  }

  void Look(std::size_t row, const RankedCost& distance, std::size_t order,
            std::priority_queue<Reach, std::vector<Reach>, std::greater<>>& reached) const
  {
    Reach reach{ this->Search.Best(row).first, row, order };
    if (reach.Offer.Exists())
    {
      // Rounding must not make a path shorter than what it is made of.
      const RankedCost cost = distance + (reach.Offer.Cost - this->RowPrices[row]);
      reach.Offer.Cost = cost < distance ? distance : cost;
      reached.push(reach);
    }
  }

  Assignment Result() const
  {
    Assignment result;
    for (std::size_t row = 0; row < this->ColumnOf.size(); ++row)
    {
      const std::size_t column = this->ColumnOf[row];
      const RankedCost& out = this->LeftOut[row];
      result.ColumnOf.push_back(column == None ? -1 : static_cast<int>(column));
      result.Cost = result.Cost + (column == None ? out : this->Search.Cost(row, column));
      const ColumnOffer best = this->Search.Best(row).first;
      result.Bound = result.Bound + (best.Exists() && best.Cost < out ? best.Cost : out);
    }
    for (const ColumnSearch::State& state : this->States)
    {
      result.Bound = result.Bound + state.Price;
    }
    return result;
  }

  void SetState(std::size_t column, const ColumnSearch::State& state)
  {
    this->States[column] = state;
    this->Search.Set(column, state);
  }

  static constexpr double FirstPart = 8.0;     // of the range, the first raise
  static constexpr double RefineBy = 5.0;      // from auction to auction
  static constexpr double FinestPart = 1000.0; // of the range for each row, the last raise
  static constexpr std::size_t MostBids = 50;  // of an auction, for each row

  ColumnSearch& Search;
  const std::vector<RankedCost>& LeftOut;
  std::vector<RankedCost> RowPrices;
  std::vector<ColumnSearch::State> States;
  std::vector<std::size_t> RowOf, ColumnOf;
  std::vector<std::size_t> From = std::vector<std::size_t>(States.size(), None);
};

class TableSearch : public ColumnSearch
{
public:
  explicit TableSearch(const AssignmentProblem& problem) : Problem(problem), States(problem.Columns)
  {
  }
  std::size_t Columns() const override { return this->Problem.Columns; }
  const std::vector<RankedCost>& LeftOut() const override { return this->Problem.LeftOut; }
  RankedCost Cost(std::size_t row, std::size_t column) const override
  {
    return this->Problem.At(row, column);
  }
  void Set(std::size_t column, const State& state) override { this->States[column] = state; }
  std::pair<ColumnOffer, ColumnOffer> Best(std::size_t row) const override
  {
    std::pair<ColumnOffer, ColumnOffer> best;
    for (std::size_t c = 0; c < this->States.size(); ++c)
    {
      const State& state = this->States[c];
      const RankedCost& cost = this->Problem.At(row, c);
      if (state.IsClosed || !cost.IsAllowed())
      {
        continue;
      }
      const ColumnOffer offer{ c, cost - state.Price, state.IsTaken };
      if (offer.IsBefore(best.first))
      {
        best = { offer, best.first };
      }
      else if (offer.IsBefore(best.second))
      {
        best.second = offer;
      }
    }
    return best;
  }

private:
  const AssignmentProblem& Problem;
  std::vector<State> States;
};

} // namespace

Assignment AssignLeastCost(ColumnSearch& search)
{
  return Assigner(search).Run();
}

std::vector<int> AssignLeastCost(const AssignmentProblem& problem)
{
  TableSearch search(problem);
  return AssignLeastCost(search).ColumnOf;
}

} // namespace waft
