# Fragments of proxy XML that several proxies share: a file says @WAFT_...@ where one comes in.

set(WAFT_TIMESTEP_VALUES [=[
      <DoubleVectorProperty name="TimestepValues" information_only="1" repeatable="1">
        <TimeStepsInformationHelper/>
        <Documentation>The times of the frames, in seconds.</Documentation>
      </DoubleVectorProperty>]=])

set(WAFT_SEED [=[
      <IntVectorProperty name="Seed" command="SetSeed" number_of_elements="1" default_values="1">
        <IntRangeDomain name="range" min="0"/>
        <Documentation>Seed of everything random in this stage. The same seed gives the same result, bit by bit, on any number of threads.</Documentation>
      </IntVectorProperty>]=])

# The scene's frame, for sources that make data without a scene file. The number of frames shows in the
# panel by default or among the advanced.
function(waft_scene_properties result visibility leastFrames)
  string(CONFIGURE [=[
      <DoubleVectorProperty name="Bounds" command="SetBounds" number_of_elements="6"
        default_values="-2 2 -2 2 0 4" panel_visibility="advanced">
        <DoubleRangeDomain name="range"/>
        <Documentation>The volume (xmin, xmax, ymin, ymax, zmin, zmax) in metres; z is up.</Documentation>
      </DoubleVectorProperty>
      <IntVectorProperty name="NumberOfFrames" label="Number Of Frames" command="SetNumberOfFrames"
        number_of_elements="1" default_values="300" panel_visibility="@visibility@">
        <IntRangeDomain name="range" min="@leastFrames@"/>
        <Documentation>Frames of the animation; frame k is at time k / FramesPerSecond.</Documentation>
      </IntVectorProperty>
      <DoubleVectorProperty name="FramesPerSecond" label="Frames Per Second" command="SetFramesPerSecond"
        number_of_elements="1" default_values="30" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0"/>
        <Documentation>Frames per second.</Documentation>
      </DoubleVectorProperty>]=] properties @ONLY)
  set(${result} "${properties}" PARENT_SCOPE)
endfunction()
waft_scene_properties(WAFT_SCENE_PROPERTIES advanced 1)
waft_scene_properties(WAFT_DATABASE_SCENE default 2)

# What drives the air of a source at random: <prefix>_NUMBERS, <prefix>_RANGES. The
# numbers show in the panel by default or among the advanced; the accelerations are the source's own.
function(waft_random_air prefix visibility vortexAcceleration windAcceleration)
  string(CONFIGURE [=[
      <DoubleVectorProperty name="WarmUpSeconds" label="Warm Up Seconds" command="SetWarmUpSeconds"
        number_of_elements="1" default_values="3" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0"/>
        <Documentation>The air starts at rest and is driven for this long before frame 0, in seconds.</Documentation>
      </DoubleVectorProperty>
      <IntVectorProperty name="NumberOfVortices" label="Number Of Vortices" command="SetNumberOfVortices"
        number_of_elements="1" default_values="10" panel_visibility="@visibility@">
        <IntRangeDomain name="range" min="0" max="1000"/>
        <Documentation>Random vortices of a run.</Documentation>
      </IntVectorProperty>
      <IntVectorProperty name="NumberOfWinds" label="Number Of Winds" command="SetNumberOfWinds"
        number_of_elements="1" default_values="6" panel_visibility="@visibility@">
        <IntRangeDomain name="range" min="0" max="1000"/>
        <Documentation>Random winds of a run, parallel, decaying in space and time.</Documentation>
      </IntVectorProperty>
      <IntVectorProperty name="NumberOfObstacles" label="Number Of Obstacles" command="SetNumberOfObstacles"
        number_of_elements="1" default_values="2" panel_visibility="@visibility@">
        <IntRangeDomain name="range" min="0" max="1000"/>
        <Documentation>Random obstacles of a run: boxes, cylinders and spheres.</Documentation>
      </IntVectorProperty>]=] numbers @ONLY)
  string(CONFIGURE [=[
      <DoubleVectorProperty name="VortexDiameter" label="Vortex Diameter" command="SetVortexDiameter"
        number_of_elements="2" default_values="0.22 0.44" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0 0"/>
        <Documentation>Range of the diameters of the random vortices, in widths of the volume: twice the radius where the acceleration at mid-segment falls to half its maximum.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="VortexLength" label="Vortex Length" command="SetVortexLength"
        number_of_elements="2" default_values="0.3 0.8" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0 0"/>
        <Documentation>Range of the lengths of the random vortices, in widths of the volume.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="VortexAcceleration" label="Vortex Acceleration" command="SetVortexAcceleration"
        number_of_elements="2" default_values="@vortexAcceleration@" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0 0"/>
        <Documentation>Range of the largest acceleration at mid-segment of the random vortices, in metres per second squared.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="VortexDuration" label="Vortex Duration" command="SetVortexDuration"
        number_of_elements="2" default_values="2 4" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0 0"/>
        <Documentation>Range of the durations of the random vortices, in seconds: the standard deviation of the Gaussian in time.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="WindRadius" label="Wind Radius" command="SetWindRadius"
        number_of_elements="2" default_values="0.2 0.5" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0 0"/>
        <Documentation>Range of the radii of the random winds, in widths of the volume.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="WindAcceleration" label="Wind Acceleration" command="SetWindAcceleration"
        number_of_elements="2" default_values="@windAcceleration@" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0 0"/>
        <Documentation>Range of the accelerations of the random winds, in metres per second squared.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="WindDuration" label="Wind Duration" command="SetWindDuration"
        number_of_elements="2" default_values="0.7 2" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0 0"/>
        <Documentation>Range of the durations of the random winds, in seconds.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="ObstacleSize" label="Obstacle Size" command="SetObstacleSize"
        number_of_elements="2" default_values="0.08 0.25" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0 0"/>
        <Documentation>Range of the extents of the random obstacles, in widths of the volume.</Documentation>
      </DoubleVectorProperty>]=] ranges @ONLY)
  set(${prefix}_NUMBERS "${numbers}" PARENT_SCOPE)
  set(${prefix}_RANGES "${ranges}" PARENT_SCOPE)
endfunction()
waft_random_air(WAFT_SMOKE default "0.23 0.92" "0.18 0.72")
waft_random_air(WAFT_DATABASE advanced "0.27 1.05" "0.16 0.65")

# A port that takes one connection of one type: @WAFT_INPUT_POLYDATA@ inside an InputProperty.
function(waft_input result type domain)
  string(CONFIGURE [=[
        <ProxyGroupDomain name="groups">
          <Group name="sources"/>
          <Group name="filters"/>
        </ProxyGroupDomain>
        <DataTypeDomain @domain@>
          <DataType value="@type@"/>
        </DataTypeDomain>]=] xml @ONLY)
  set(${result} "${xml}" PARENT_SCOPE)
endfunction()
waft_input(WAFT_INPUT_POLYDATA vtkPolyData [[name="input_type"]])
waft_input(WAFT_INPUT_IMAGE vtkImageData [[name="input_type"]])
waft_input(WAFT_INPUT_MULTIBLOCK vtkMultiBlockDataSet [[name="input_type" composite_data_supported="1"]])
