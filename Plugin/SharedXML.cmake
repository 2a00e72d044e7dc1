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

# The scene's frame, for sources that make data without a scene file.
set(WAFT_SCENE_PROPERTIES [=[
      <DoubleVectorProperty name="Bounds" command="SetBounds" number_of_elements="6"
        default_values="-2 2 -2 2 0 4" panel_visibility="advanced">
        <DoubleRangeDomain name="range"/>
        <Documentation>The volume (xmin, xmax, ymin, ymax, zmin, zmax) in metres; z is up.</Documentation>
      </DoubleVectorProperty>
      <IntVectorProperty name="NumberOfFrames" label="Number Of Frames" command="SetNumberOfFrames"
        number_of_elements="1" default_values="300" panel_visibility="advanced">
        <IntRangeDomain name="range" min="1"/>
        <Documentation>Frames of the animation; frame k is at time k / FramesPerSecond.</Documentation>
      </IntVectorProperty>
      <DoubleVectorProperty name="FramesPerSecond" label="Frames Per Second" command="SetFramesPerSecond"
        number_of_elements="1" default_values="30" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0"/>
        <Documentation>Frames per second.</Documentation>
      </DoubleVectorProperty>]=])

# A port that takes one connection of one type: @WAFT_INPUT_POLYDATA@ inside an InputProperty.
set(WAFT_INPUT_POLYDATA [=[
        <ProxyGroupDomain name="groups">
          <Group name="sources"/>
          <Group name="filters"/>
        </ProxyGroupDomain>
        <DataTypeDomain name="input_type">
          <DataType value="vtkPolyData"/>
        </DataTypeDomain>]=])
set(WAFT_INPUT_IMAGE [=[
        <ProxyGroupDomain name="groups">
          <Group name="sources"/>
          <Group name="filters"/>
        </ProxyGroupDomain>
        <DataTypeDomain name="input_type">
          <DataType value="vtkImageData"/>
        </DataTypeDomain>]=])
set(WAFT_INPUT_MULTIBLOCK [=[
        <ProxyGroupDomain name="groups">
          <Group name="sources"/>
          <Group name="filters"/>
        </ProxyGroupDomain>
        <DataTypeDomain name="input_type" composite_data_supported="1">
          <DataType value="vtkMultiBlockDataSet"/>
        </DataTypeDomain>]=])
