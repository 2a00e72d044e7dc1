// SPDX-License-Identifier: BSD-3-Clause
// Flies a scene file into a folder of results, and says how far it is.
#include "Bridge/Run/FlyScene.h"

#include <cstdlib>
#include <iostream>

namespace
{

class Told : public waft::FlightMonitor
{
public:
  void Begin(waft::ChainStage stage) override
  {
    std::cout << waft::TraitsOf(stage).Sentence << "\n";
  }
};

} // namespace

int main(int count, char** words) // SCENE FOLDER
{
  waft::FlightRequest request;
  request.Scene = count > 1 ? words[1] : "";
  request.Output = count > 2 ? words[2] : "";
  request.Options = waft::ChainOptions::At(waft::Quality::Preview);
  Told told;
  waft::Flight flight;
  const waft::Result result = waft::FlyScene(request, nullptr, told, flight);
  std::cout << (result ? flight.IsMet() ? "all met" : "not all met" : result.Message()) << "\n";
  return result ? EXIT_SUCCESS : EXIT_FAILURE;
}
